#include "suture/ode/tissue_ode.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ode/block_list.hpp"
#include "ode/cell_preconditioner.hpp"
#include "ode/contact_factors.hpp"
#include "ode/membrane_crossing.hpp"
#include "ode/tissue_gradient.hpp"
#include "ode/sparse_direct.hpp"
#include "suture/errors.hpp"

namespace suture {

struct TissueOde::Impl : TissueGradient {
  Impl(const Tissue& tissue_in, int ring, TissueOdeOptions options_in,
       std::vector<std::shared_ptr<const EnergyTerm>> extra_in, SharedValues reference_in)
      : TissueGradient(tissue_in, ring, std::move(options_in), std::move(extra_in)),
        preconditioner(tissue, padded, ring, kernel),
        direct(tissue, padded),
        reference(std::move(reference_in)),
        reference_length(reference.empty() ? tissue.initial_rest_lengths() : reference) {
    for (int c = 0; c < tissue.cell_count(); ++c) {
      const CellMaterial& m = tissue.material(c);
      inverse_tau.push_back(options.plastic && std::isfinite(m.tau) ? 1.0 / m.tau : 0.0);
      memory.push_back(m.memory);
    }
  }

  StateView positions_view(std::span<const double> q) const {
    StateView view;
    view.x = q.first(layout.points());
    view.y = q.subspan(layout.points(), layout.points());
    return view;
  }

  /// task(block), several at once.
  template <class Task>
  void for_each_block(const Task& task) {
    workers.for_each(padded.blocks(), task);
  }

  /// visit(range) of the x and of the y components of the points of one block.
  template <class Visit>
  void visit_positions(int block, const Visit& visit) const {
    const Range points = points_of(block);
    const auto all = static_cast<std::size_t>(layout.points());
    visit(points);
    visit(Range{all + points.begin, all + points.end});
  }

  CellPreconditioner preconditioner;
  LinearSolver linear_solver = LinearSolver::structured;
  SparseDirect direct;
  bool factored_directly = false;
  std::vector<double> inverse_tau, memory;  // per cell
  SharedValues reference;  // empty: l0(0)
  std::span<const double> reference_length;

  // The implicit step in progress.
  double step_time = 0.0, gamma = 0.0;
  std::span<const double> psi;
  ContactFactors factors;
  BlockList extra_blocks;
  std::span<const double> evaluated_at;  // q of the last residual, for the extra terms
};

TissueOde::TissueOde(const Tissue& tissue, int ring_size, TissueOdeOptions options,
                     std::vector<std::shared_ptr<const EnergyTerm>> extra, SharedValues reference_rest_length)
    : impl_(std::make_unique<Impl>(tissue, ring_size, std::move(options), std::move(extra), std::move(reference_rest_length))) {}
TissueOde::~TissueOde() = default;

const StateLayout& TissueOde::layout() const { return impl_->layout; }
void TissueOde::replace_extra(int ring_size, std::vector<std::shared_ptr<const EnergyTerm>> extra) {
  Impl& m = *impl_;
  m.layout.ring = ring_size;
  m.extra = std::move(extra);
  m.preconditioner.set_ring_size(ring_size);
}
int TissueOde::size() const { return impl_->layout.size(); }
int TissueOde::position_count() const { return impl_->layout.positions(); }
std::string TissueOde::refusal() const { return impl_->refusal; }
long TissueOde::list_rebuilds() const { return impl_->rebuilds; }

bool TissueOde::jumps(std::span<const double> before, std::span<const double> after) {
  constexpr double resolved = 0.2;  // of the contact distance: two vertices that move so far do not get from one side of a contact to the other
  const Impl& m = *impl_;
  const std::size_t points = m.layout.points(), vertices = m.layout.vertices;
  const double far = resolved * *m.options.contact.distance;
  if (m.kernel.largest_move2(vertices, &after[0], &after[points], &before[0], &before[points]) < far * far) return false;
  const int vertex = vertex_through_membrane(m.tissue, m.padded, m.list, before.first(2 * points), after.first(2 * points));
  if (vertex < 0) return false;
  impl_->refusal = m.tissue.vertex_name(vertex) + " went through the membrane of another cell in one step";
  return true;
}

std::string TissueOde::component_name(int i) const {
  const StateLayout& l = impl_->layout;
  if (i >= l.positions()) return impl_->tissue.vertex_name(i - l.positions()) + ", rest length";
  return fmt::format("{}, {}", impl_->point_name(i % l.points()), i < l.points() ? "x" : "y");
}

Evaluation TissueOde::gradient(double t, const StateView& state, MutableStateView gradient) {
  impl_->hold_rest_lengths(state.rest_length);
  return impl_->evaluate(t, state, gradient.x, gradient.y, [&](int block) { return impl_->finite(gradient.x, gradient.y, block); });
}

Evaluation TissueOde::rate(double t, std::span<const double> y, std::span<double> out) {
  Impl& m = *impl_;
  const StateView state(m.layout, y);
  MutableStateView rate(m.layout, out);
  m.hold_rest_lengths(state.rest_length, {m.inverse_tau.data(), m.memory.data(), m.reference_length.data(), rate.rest_length.data()});
  return m.evaluate(t, state, rate.x, rate.y, [&](int block) {
    const Range points = m.points_of(block);
    const std::size_t n = points.end - points.begin;
    const bool fine_x = m.kernel.negate(n, &rate.x[points.begin]), fine_y = m.kernel.negate(n, &rate.y[points.begin]);
    return fine_x && fine_y;
  });
}

void TissueOde::begin_implicit_step(double t, double gamma, std::span<const double> psi) {
  Impl& m = *impl_;
  m.step_time = t;
  m.gamma = gamma;
  m.psi = psi;
  m.let_rest_lengths_follow();
  const double* memory_psi = psi.data() + m.layout.positions();
  m.for_each_block([&](int block) {
    for (std::size_t c = m.padded.cells_of(block).begin; c < m.padded.cells_of(block).end; ++c) {
      const double r = gamma * m.inverse_tau[c], scale = 1.0 / (1.0 + r), memory = m.memory[c];
      const int cell = static_cast<int>(c), first = m.tissue.first_vertex(cell), n = m.tissue.vertex_count(cell);
      double *a = m.padded.shell.rest_a + m.padded.shell.base[c] + 1, *b = m.padded.shell.rest_b + m.padded.shell.base[c] + 1;
      for (int k = 0; k < n; ++k) a[k] = (memory_psi[first + k] + r * memory * m.reference_length[first + k]) * scale;
      std::fill_n(b, n, r * (1.0 - memory) * scale);
      m.padded.repeat_ends(m.padded.shell.rest_a, cell);
      m.padded.repeat_ends(m.padded.shell.rest_b, cell);
    }
  });
}

Evaluation TissueOde::residual(std::span<const double> q, std::span<double> residual) {
  Impl& m = *impl_;
  const int points = m.layout.points();
  const Evaluation evaluation =
      m.evaluate(m.step_time, m.positions_view(q), residual.first(points), residual.subspan(points, points), [&](int block) {
        bool fine = true;
        m.visit_positions(block, [&](Range r) {
          fine &= m.kernel.implicit_residual(r.end - r.begin, &q[r.begin], &m.psi[r.begin], m.gamma, &residual[r.begin]);
        });
        return fine;
      });
  m.evaluated_at = q;
  return evaluation;
}

void TissueOde::linearise() {
  Impl& m = *impl_;
  m.for_each_block([&](int block) {
    if (m.padded.blocks() > 1) m.kernel.shell_segments(m.padded.shell_of(block));
    m.kernel.shell_linearise(m.padded.shell_of(block), m.padded.hessian_of(block));
  });
  m.factors.linearise(m.list, m.padded.shell, m.contact, m.kernel, m.workers);
  m.extra_blocks.clear();
  for (const auto& term : m.extra) term->add_hessian(m.step_time, m.positions_view(m.evaluated_at), m.extra_blocks);
}

void TissueOde::product(std::span<const double> v, std::span<double> out) {
  Impl& m = *impl_;
  const int vertices = m.layout.vertices, points = m.layout.points();
  const kernels::ShellHessian& h = m.padded.hessian;
  m.factors.for_each_list(m.workers, [&](int list, std::span<const kernels::ContactFactor> factors) {
    if (list < m.padded.blocks()) {  // just before its contacts, while it is in the cache
      m.padded.unpack(v.first(vertices), h.vx, list);
      m.padded.unpack(v.subspan(points, vertices), h.vy, list);
      m.kernel.shell_product(m.padded.shell_of(list), m.padded.hessian_of(list));
    }
    m.kernel.contact_product(factors.data(), factors.size(), h.vx, h.vy, h.ox, h.oy);
  });
  std::fill_n(out.begin() + vertices, points - vertices, 0.0);
  std::fill_n(out.begin() + points + vertices, points - vertices, 0.0);
  m.for_each_block([&](int block) {
    m.padded.fold_and_pack(h.ox, out.first(vertices), block);
    m.padded.fold_and_pack(h.oy, out.subspan(points, vertices), block);
    m.visit_positions(block, [&](Range r) { m.kernel.linear_sum(r.end - r.begin, 1.0, &v[r.begin], m.gamma, &out[r.begin], &out[r.begin]); });
  });
  m.extra_blocks.add_product(m.gamma, m.layout, v, out);
}

void TissueOde::choose_linear_solver(LinearSolver solver) { impl_->linear_solver = solver; }

void TissueOde::set_up_preconditioner() {
  Impl& m = *impl_;
  m.factored_directly = m.linear_solver == LinearSolver::sparse_direct &&
                         m.direct.factor(m.gamma, m.layout.points(), m.factors, m.extra_blocks);
  if (!m.factored_directly) m.preconditioner.set_up(m.gamma, m.factors, m.extra_blocks.blocks, m.workers);
}

void TissueOde::precondition(std::span<const double> r, std::span<double> z) {
  if (impl_->factored_directly)
    impl_->direct.solve(r, z);
  else
    impl_->preconditioner.apply(r, z, impl_->workers);
}

namespace {

/// The factor by which the ends of segment i, j should move less relative to each other than the step d says; 1 mostly. A
/// collapsed segment is soon turned round or shortened away, and its direction is far from linear in the positions of its
/// ends. One that keeps its direction within 60 degrees and half its length may change as it likes.
double segment_limit(std::span<const double> q, std::span<const double> d, int i, int j) {
  constexpr double most = 0.5;  // of its length is what the ends may move otherwise
  const std::size_t points = q.size() / 2;
  const double ex = q[j] - q[i], ey = q[points + j] - q[points + i];
  const double rx = d[j] - d[i], ry = d[points + j] - d[points + i];
  const double length2 = ex * ex + ey * ey, change2 = rx * rx + ry * ry;
  const double along = length2 + ex * rx + ey * ry;  // the segment as it is times as it would be
  const double after2 = length2 + 2.0 * (ex * rx + ey * ry) + change2;
  if (!(change2 > most * most * length2) || (along > 0.5 * length2 && along * along > 0.25 * length2 * after2)) return 1.0;
  return most * std::sqrt(length2 / change2);
}

}  // namespace

/// Only the motion of the ends relative to each other is limited, so that one such segment does not hold up the tissue.
void TissueOde::limit_step(std::span<const double> q, std::span<double> d) const {
  const Tissue& tissue = impl_->tissue;
  const std::size_t points = q.size() / 2;
  for (int c = 0; c < tissue.cell_count(); ++c)
    for (int i = tissue.end_vertex(c) - 1, j = tissue.first_vertex(c); j < tissue.end_vertex(c); i = j++) {
      const double limit = segment_limit(q, d, i, j);
      if (limit == 1.0) continue;
      const double x = 0.5 * (1.0 - limit) * (d[j] - d[i]), y = 0.5 * (1.0 - limit) * (d[points + j] - d[points + i]);
      d[i] += x, d[points + i] += y;
      d[j] -= x, d[points + j] -= y;
    }
}

double TissueOde::step_limit(std::span<const double> q, std::span<const double> d) const {
  const Tissue& tissue = impl_->tissue;
  double limit = 1.0;
  for (int c = 0; c < tissue.cell_count(); ++c)
    for (int i = tissue.end_vertex(c) - 1, j = tissue.first_vertex(c); j < tissue.end_vertex(c); i = j++)
      limit = std::min(limit, segment_limit(q, d, i, j));
  return limit;
}

void TissueOde::recover_memory(std::span<const double> q, std::span<double> memory) {
  Impl& m = *impl_;
  m.for_each_block([&](int block) {
    const std::size_t first = m.padded.vertices_of(block).begin;
    m.kernel.rest_lengths(m.padded.shell_of(block), {&q[first], &q[m.layout.points() + first], &memory[first]});
  });
}

WorkerPool& TissueOde::workers() { return impl_->workers; }

}  // namespace suture
