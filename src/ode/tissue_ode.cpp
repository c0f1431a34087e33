#include "suture/ode/tissue_ode.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "neighbors/contact_list.hpp"
#include "ode/block_list.hpp"
#include "ode/cell_preconditioner.hpp"
#include "ode/padded_tissue.hpp"
#include "ode/sparse_direct.hpp"
#include "suture/errors.hpp"

namespace suture {

namespace {

kernels::ContactScalars contact_scalars(const ContactParameters& p) {
  const double e = p.energy, s = *p.distance, l1 = p.adhesion, l2 = p.range;
  kernels::ContactScalars c;
  const bool adhesive = l1 > 0.0;
  const double cutoff = s * (adhesive ? 1.0 + l2 : 1.0), inner = s * (1.0 + l1);
  c.cutoff2 = cutoff * cutoff;
  c.inner2 = inner * inner;
  c.inner_a = -2.0 * e / s;
  c.inner_b = 2.0 * e / (s * s);
  const double outer = adhesive ? 2.0 * e * l1 / (l2 - l1) : 0.0;
  c.outer_a = outer * (1.0 + l2) / s;
  c.outer_b = -outer / (s * s);
  c.self2 = p.self_contact ? s * s : 0.0;
  return c;
}

}  // namespace

struct TissueOde::Impl {
  Impl(const Tissue& tissue_in, int ring, TissueOdeOptions options_in,
       std::vector<std::shared_ptr<const EnergyTerm>> extra_in, std::span<const double> reference)
      : tissue(tissue_in),
        layout{tissue_in.vertex_count(), ring},
        options(std::move(options_in)),
        extra(std::move(extra_in)),
        kernel(kernels::best()),
        padded(tissue, options.membrane_law),
        contact(contact_scalars(options.contact)),
        list(std::sqrt(contact.cutoff2), std::sqrt(contact.self2), options.skin),
        preconditioner(tissue, padded, ring, kernel),
        direct(tissue, padded) {
    const int vertices = tissue.vertex_count();
    for (int v = 0; v < vertices; ++v) {
      const CellMaterial& m = tissue.material(tissue.cell_of(v));
      inverse_tau.push_back(options.plastic && std::isfinite(m.tau) ? 1.0 / m.tau : 0.0);
      memory.push_back(m.memory);
      reference_length.push_back(reference.empty() ? tissue.initial_rest_length(v) : reference[v]);
    }
    for (auto* array : {&built_x, &built_y, &length, &rest_a, &rest_b}) array->resize(vertices);
    position_psi.resize(layout.positions());
  }

  /// Rest lengths as they are in a plain rate evaluation.
  void hold_rest_lengths(std::span<const double> rest_length) {
    padded.unpack(rest_length, padded.shell.rest_a);
    if (!plain) std::fill_n(padded.shell.rest_b, padded.slots(), 0.0);
    plain = true;
  }

  /// dU/dr at (x, y) with the rest lengths set before; gx, gy have one entry per point.
  Evaluation evaluate(double t, const StateView& state, std::span<double> gx, std::span<double> gy) {
    const int vertices = layout.vertices;
    padded.unpack(state.x.first(vertices), padded.shell.x);
    padded.unpack(state.y.first(vertices), padded.shell.y);
    kernel.shell_gradient(padded.shell);
    if (!healthy()) return Evaluation::refused;
    if (list_is_stale(state)) rebuild(state);
    kernel.contact_gradient(padded.shell, contact, list.windows().data(), list.windows().size(), list.self_pairs().data(),
                            list.self_pairs().size());
    padded.fold_and_pack(padded.shell.gx, gx.first(vertices));
    padded.fold_and_pack(padded.shell.gy, gy.first(vertices));
    std::fill(gx.begin() + vertices, gx.end(), 0.0);
    std::fill(gy.begin() + vertices, gy.end(), 0.0);
    MutableStateView gradient;
    gradient.x = gx, gradient.y = gy;
    for (const auto& term : extra) term->add_gradient(t, state, gradient);
    return finite(gx, gy);
  }

  bool healthy() {
    const kernels::Shell& s = padded.shell;
    for (int c = 0; c < s.cells; ++c)
      if (!(s.area[c] > 0.0)) {
        refusal = std::isfinite(s.area[c]) ? fmt::format("cell {} is inverted (area {:.3g})", c, s.area[c])
                                           : fmt::format("cell {} has a position that is not finite", c);
        return false;
      }
    const auto bad = [&s](int k) { return !(s.length[k] > 0.0) | !(s.rest_a[k] + s.rest_b[k] * s.length[k] > 0.0); };
    int failures = 0;  // counted first: that loop vectorises, and there are none as a rule
    for (int c = 0; c < s.cells; ++c)
      for (int k = s.base[c] + 1; k <= s.base[c] + s.count[c]; ++k) failures += bad(k);
    if (failures == 0) return true;
    int worst = 0;
    for (int c = 0; c < s.cells; ++c)
      for (int k = s.base[c] + 1; k <= s.base[c] + s.count[c]; ++k)
        if (bad(k)) worst = k;
    refusal = fmt::format("{}: its segment has length {:.3g} and rest length {:.3g}", tissue.vertex_name(padded.vertex(worst)),
                          s.length[worst], s.rest_a[worst] + s.rest_b[worst] * s.length[worst]);
    return false;
  }

  Evaluation finite(std::span<const double> gx, std::span<const double> gy) {
    bool bad = false;
    for (std::size_t k = 0; k < gx.size(); ++k) bad |= !(std::abs(gx[k]) + std::abs(gy[k]) < 1e300);
    if (!bad) return Evaluation::ok;
    for (std::size_t k = 0; k < gx.size(); ++k)
      if (!(std::abs(gx[k]) + std::abs(gy[k]) < 1e300)) {
        refusal = fmt::format("{}: the force is not finite (two membranes meet in one point)", point_name(static_cast<int>(k)));
        break;
      }
    return Evaluation::refused;
  }

  bool list_is_stale(const StateView& state) const {
    if (rebuilds == 0) return true;
    const double limit = 0.25 * options.skin * options.skin;
    bool moved = false;
    for (int k = 0; k < layout.vertices; ++k) {
      const double dx = state.x[k] - built_x[k], dy = state.y[k] - built_y[k];
      moved |= dx * dx + dy * dy > limit;
    }
    return moved;
  }

  void rebuild(const StateView& state) {
    list.build(padded.shell, kernel);
    std::copy_n(state.x.begin(), layout.vertices, built_x.begin());
    std::copy_n(state.y.begin(), layout.vertices, built_y.begin());
    ++rebuilds;
  }

  std::string point_name(int point) const {
    return point < layout.vertices ? tissue.vertex_name(point)
                                   : fmt::format("purse-string vertex {}", point - layout.vertices);
  }

  StateView positions_view(std::span<const double> q) const {
    StateView view;
    view.x = q.first(layout.points());
    view.y = q.subspan(layout.points(), layout.points());
    return view;
  }

  Tissue tissue;
  StateLayout layout;
  TissueOdeOptions options;
  std::vector<std::shared_ptr<const EnergyTerm>> extra;
  const kernels::Table& kernel;
  PaddedTissue padded;
  kernels::ContactScalars contact;
  ContactList list;
  CellPreconditioner preconditioner;
  LinearSolver linear_solver = LinearSolver::structured;
  SparseDirect direct;
  bool factored_directly = false;
  std::vector<double> inverse_tau, memory, reference_length;
  std::vector<double> built_x, built_y;  // positions the list was built for
  std::vector<double> length;
  long rebuilds = 0;
  bool plain = false;  // rest_b is zero everywhere
  std::string refusal;

  // The implicit step in progress.
  double step_time = 0.0, gamma = 0.0;
  std::vector<double> position_psi, rest_a, rest_b;
  std::vector<kernels::ContactFactor> factors;
  std::size_t factor_count = 0;
  BlockList extra_blocks;
  std::vector<double> linearised_at;  // q of the last residual, for the extra terms
};

TissueOde::TissueOde(const Tissue& tissue, int ring_size, TissueOdeOptions options,
                     std::vector<std::shared_ptr<const EnergyTerm>> extra, std::span<const double> reference_rest_length)
    : impl_(std::make_unique<Impl>(tissue, ring_size, std::move(options), std::move(extra), reference_rest_length)) {}
TissueOde::~TissueOde() = default;

const StateLayout& TissueOde::layout() const { return impl_->layout; }
void TissueOde::replace_extra(int ring_size, std::vector<std::shared_ptr<const EnergyTerm>> extra) {
  Impl& m = *impl_;
  m.layout.ring = ring_size;
  m.extra = std::move(extra);
  m.position_psi.resize(m.layout.positions());
  m.preconditioner.set_ring_size(ring_size);
}
int TissueOde::size() const { return impl_->layout.size(); }
int TissueOde::position_count() const { return impl_->layout.positions(); }
std::string TissueOde::refusal() const { return impl_->refusal; }
long TissueOde::list_rebuilds() const { return impl_->rebuilds; }

std::string TissueOde::component_name(int i) const {
  const StateLayout& l = impl_->layout;
  if (i >= l.positions()) return impl_->tissue.vertex_name(i - l.positions()) + ", rest length";
  return fmt::format("{}, {}", impl_->point_name(i % l.points()), i < l.points() ? "x" : "y");
}

Evaluation TissueOde::gradient(double t, const StateView& state, MutableStateView gradient) {
  impl_->hold_rest_lengths(state.rest_length);
  return impl_->evaluate(t, state, gradient.x, gradient.y);
}

Evaluation TissueOde::rate(double t, std::span<const double> y, std::span<double> out) {
  Impl& m = *impl_;
  const StateView state(m.layout, y);
  MutableStateView rate(m.layout, out);
  m.hold_rest_lengths(state.rest_length);
  const Evaluation evaluation = m.evaluate(t, state, rate.x, rate.y);
  if (evaluation != Evaluation::ok) return evaluation;
  for (int k = 0; k < m.layout.positions(); ++k) out[k] = -out[k];
  m.padded.pack(m.padded.shell.length, m.length);
  for (int v = 0; v < m.layout.vertices; ++v)  // [P] Eq. 5 and 10
    rate.rest_length[v] = -m.inverse_tau[v] * ((state.rest_length[v] - m.length[v]) + m.memory[v] * (m.length[v] - m.reference_length[v]));
  return evaluation;
}

void TissueOde::begin_implicit_step(double t, double gamma, std::span<const double> psi) {
  Impl& m = *impl_;
  m.step_time = t;
  m.gamma = gamma;
  std::copy_n(psi.begin(), m.layout.positions(), m.position_psi.begin());
  const double* memory_psi = psi.data() + m.layout.positions();
  for (int v = 0; v < m.layout.vertices; ++v) {
    const double r = gamma * m.inverse_tau[v], scale = 1.0 / (1.0 + r);
    m.rest_a[v] = (memory_psi[v] + r * m.memory[v] * m.reference_length[v]) * scale;
    m.rest_b[v] = r * (1.0 - m.memory[v]) * scale;
  }
  m.padded.unpack(m.rest_a, m.padded.shell.rest_a);
  m.padded.unpack(m.rest_b, m.padded.shell.rest_b);
  m.plain = false;
}

Evaluation TissueOde::residual(std::span<const double> q, std::span<double> residual) {
  Impl& m = *impl_;
  const int points = m.layout.points();
  const Evaluation evaluation = m.evaluate(m.step_time, m.positions_view(q), residual.first(points), residual.subspan(points, points));
  if (evaluation != Evaluation::ok) return evaluation;
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] = (q[k] - m.position_psi[k]) + m.gamma * residual[k];
  if (!m.extra.empty()) m.linearised_at.assign(q.begin(), q.end());
  return evaluation;
}

void TissueOde::linearise() {
  Impl& m = *impl_;
  // Curvature below -0.3/gamma would make I + gamma H indefinite; leaving it out of the Newton matrix costs iterations,
  // not accuracy (studies: 918 -> 20 negative-curvature stops).
  const double lowest = -0.3 / m.gamma;
  m.kernel.shell_linearise(m.padded.shell, m.padded.hessian);
  m.factors.resize(std::max(m.factors.size(), 8 * m.list.windows().size() + m.list.self_pairs().size()));
  m.factor_count = m.kernel.contact_linearise(m.padded.shell, m.contact, m.list.windows().data(), m.list.windows().size(),
                                              m.list.self_pairs().data(), m.list.self_pairs().size(), lowest, m.factors.data());
  m.extra_blocks.clear();
  for (const auto& term : m.extra) term->add_hessian(m.step_time, m.positions_view(m.linearised_at), m.extra_blocks);
}

void TissueOde::product(std::span<const double> v, std::span<double> out) {
  Impl& m = *impl_;
  const int vertices = m.layout.vertices, points = m.layout.points();
  kernels::ShellHessian& h = m.padded.hessian;
  m.padded.unpack(v.first(vertices), h.vx);
  m.padded.unpack(v.subspan(points, vertices), h.vy);
  m.kernel.shell_product(m.padded.shell, h);
  m.kernel.contact_product(m.factors.data(), m.factor_count, h.vx, h.vy, h.ox, h.oy);
  m.padded.fold_and_pack(h.ox, out.first(vertices));
  m.padded.fold_and_pack(h.oy, out.subspan(points, vertices));
  std::fill_n(out.begin() + vertices, points - vertices, 0.0);
  std::fill_n(out.begin() + points + vertices, points - vertices, 0.0);
  for (std::size_t k = 0; k < v.size(); ++k) out[k] = v[k] + m.gamma * out[k];
  m.extra_blocks.add_product(m.gamma, m.layout, v, out);
}

void TissueOde::choose_linear_solver(LinearSolver solver) { impl_->linear_solver = solver; }

void TissueOde::set_up_preconditioner() {
  Impl& m = *impl_;
  const std::span<const kernels::ContactFactor> contacts(m.factors.data(), m.factor_count);
  m.factored_directly = m.linear_solver == LinearSolver::sparse_direct &&
                        m.direct.factor(m.gamma, m.layout.points(), contacts, m.extra_blocks);
  if (!m.factored_directly) m.preconditioner.set_up(m.gamma, contacts, m.extra_blocks.blocks);
}

void TissueOde::precondition(std::span<const double> r, std::span<double> z) {
  if (impl_->factored_directly)
    impl_->direct.solve(r, z);
  else
    impl_->preconditioner.apply(r, z);
}

void TissueOde::recover_memory(std::span<const double> q, std::span<double> memory) {
  Impl& m = *impl_;
  const double *x = q.data(), *y = q.data() + m.layout.points();
  for (int c = 0; c < m.tissue.cell_count(); ++c) {
    const int first = m.tissue.first_vertex(c), end = m.tissue.end_vertex(c);
    for (int v = first; v < end; ++v) {
      const int w = v + 1 == end ? first : v + 1;
      const double dx = x[w] - x[v], dy = y[w] - y[v];
      memory[v] = m.rest_a[v] + m.rest_b[v] * std::sqrt(dx * dx + dy * dy);
    }
  }
}

}  // namespace suture
