#include "ode/tissue_gradient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr int cells_per_block = 64;  // their arrays fit into the second-level cache

bool divided(const Tissue& tissue) { return tissue.vertex_count() >= divided_from_vertices; }

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

/// The same memory for every tissue a thread works on; nobody relies on what is in it.
double* room_of_thread(std::size_t doubles) {
  thread_local AlignedBuffer room;
  thread_local std::size_t size = 0;
  if (size < doubles) room = AlignedBuffer(size = doubles);
  return room.data();
}

}  // namespace

TissueGradient::TissueGradient(const Tissue& tissue_in, int ring, TissueOdeOptions options_in,
                               std::vector<std::shared_ptr<const EnergyTerm>> extra_in)
    : tissue(tissue_in),
      layout{tissue_in.vertex_count(), ring},
      options(std::move(options_in)),
      extra(std::move(extra_in)),
      kernel(kernels::best()),
      workers(divided(tissue) ? options.threads : 1),
      padded(tissue, options.membrane_law, divided(tissue) ? cells_per_block : 0),
      contact(contact_scalars(options.contact)),
      list(std::sqrt(contact.cutoff2), std::sqrt(contact.self2), options.skin, divided(tissue) ? cells_per_block : 0),
      built_x_(tissue.vertex_count()),
      built_y_(tissue.vertex_count()),
      moved2_(padded.blocks()) {
  int most = 0;
  for (int c = 0; c < tissue.cell_count(); ++c) most = std::max(most, tissue.vertex_count(c));
  room_stride_ = kernels::SegmentRoom::cells * static_cast<std::size_t>((most + kernels::halo + 7) / 8 * 8) + 8;
}

void TissueGradient::hold_rest_lengths(std::span<const double> rest_length, const kernels::RestLengthFlow& flow) {
  held_ = rest_length.data();
  flow_ = flow;
}

void TissueGradient::let_rest_lengths_follow() {
  held_ = nullptr;
  flow_ = {};
}

Range TissueGradient::points_of(int block) const {
  const Range vertices = padded.vertices_of(block);
  return {vertices.begin, block + 1 < padded.blocks() ? vertices.end : static_cast<std::size_t>(layout.points())};
}

void TissueGradient::add_shell(const StateView& state, int block, bool keep) {
  const std::size_t first = padded.vertices_of(block).begin, cell = padded.cells_of(block).begin;
  kernels::ShellInput in{state.x.data() + first, state.y.data() + first, held_ != nullptr ? held_ + first : nullptr};
  if (flow_.rate != nullptr) in.flow = {flow_.inverse_tau + cell, flow_.memory + cell, flow_.reference + first, flow_.rate + first};
  if (!keep) in.room = {room_of_thread(kernels::SegmentRoom::arrays * room_stride_), room_stride_};
  if (!kernel.shell_gradient(padded.shell_of(block), in)) unhealthy_ = true;
}

/// How far somebody of a block is from where the list was built, squared.
double TissueGradient::largest_move2(const StateView& state, int block) const {
  const auto [begin, end] = padded.vertices_of(block);
  return kernel.largest_move2(end - begin, &state.x[begin], &state.y[begin], &built_x_[begin], &built_y_[begin]);
}

void TissueGradient::add_contacts(int k) {
  const ContactList::Entries& entries = list.entries(k);
  kernel.contact_gradient(padded.shell, contact, entries.groups.data(), list.active(k), entries.self_pairs.data(), entries.self_pairs.size());
}

/// A block is looked at just before its contacts, while it is in the cache.
bool TissueGradient::add_list(const StateView& state, int k, bool keep) {
  if (k < padded.blocks()) {
    moved2_[k] = largest_move2(state, k);
    if (!(2.0 * std::sqrt(moved2_[k]) <= options.skin)) return false;
    add_shell(state, k, keep);
  }
  double moved2 = 0.0;
  for (const int block : list.entries(k).blocks) moved2 = std::max(moved2, moved2_[block]);
  list.age(k, std::sqrt(moved2));
  add_contacts(k);
  return true;
}

void TissueGradient::add_terms(double t, const StateView& state, std::span<double> gx, std::span<double> gy) {
  MutableStateView gradient;
  gradient.x = gx, gradient.y = gy;
  for (const auto& term : extra) term->add_gradient(t, state, gradient);
}

void TissueGradient::explain_unhealthy(const StateView& state) {
  for (int block = 0; block < padded.blocks(); ++block) add_shell(state, block, true);
  const kernels::Shell& s = padded.shell;
  for (int c = 0; c < s.cells; ++c)
    if (!(s.area[c] > 0.0)) {
      refusal = std::isfinite(s.area[c]) ? fmt::format("cell {} is inverted (area {:.3g})", c, s.area[c])
                                         : fmt::format("cell {} has a position that is not finite", c);
      return;
    }
  const auto rest_length = [&](int k) { return held_ != nullptr ? s.rest_a[k] : s.rest_a[k] + s.rest_b[k] * s.length[k]; };
  int worst = 0;
  for (int c = 0; c < s.cells; ++c)
    for (int k = s.base[c] + 1; k <= s.base[c] + s.count[c]; ++k)
      if (!(s.length[k] > 0.0) || !(rest_length(k) > 0.0)) worst = k;
  refusal = fmt::format("{}: its segment has length {:.3g} and rest length {:.3g}", tissue.vertex_name(padded.vertex(worst)),
                        s.length[worst], rest_length(worst));
}

bool TissueGradient::finite(std::span<const double> gx, std::span<const double> gy, int block) const {
  const Range points = points_of(block);
  const std::size_t n = points.end - points.begin;
  return kernel.finite(n, gx.data() + points.begin) && kernel.finite(n, gy.data() + points.begin);
}

/// Finishing a block leaves finite what was finite, and no more.
void TissueGradient::explain_infinite(std::span<const double> gx, std::span<const double> gy) {
  for (std::size_t k = 0; k < gx.size(); ++k)
    if (!kernel.finite(1, &gx[k]) || !kernel.finite(1, &gy[k])) {
      refusal = fmt::format("{}: the force is not finite (two membranes meet in one point)", point_name(static_cast<int>(k)));
      return;
    }
}

void TissueGradient::rebuild(const StateView& state) {
  list.build(padded.shell, kernel, workers);
  std::copy_n(state.x.begin(), layout.vertices, built_x_.begin());
  std::copy_n(state.y.begin(), layout.vertices, built_y_.begin());
  ++rebuilds;
}

std::string TissueGradient::point_name(int point) const {
  return point < layout.vertices ? tissue.vertex_name(point) : fmt::format("purse-string vertex {}", point - layout.vertices);
}

}  // namespace suture
