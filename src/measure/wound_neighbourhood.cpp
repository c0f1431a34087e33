#include "suture/measure/wound_neighbourhood.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "measure/exposure_core.hpp"

namespace suture {

namespace {

BoundingBox around(const Wound& wound, double distance) {
  const BoundingBox box = bounding_box(wound.outline);
  return {box.x_low - distance, box.x_high + distance, box.y_low - distance, box.y_high + distance};
}

bool lies_inside(const BoundingBox& box, const BoundingBox& region) {
  return box.x_low > region.x_low && box.x_high < region.x_high && box.y_low > region.y_low && box.y_high < region.y_high;
}

}  // namespace

WoundNeighbourhood::WoundNeighbourhood(const Membrane& membrane, double margin)
    : margin_(margin), tracker_(membrane) {}

void WoundNeighbourhood::look_at_all() {
  cells_.clear();
  forget_part();
}

/// The box is kept as long as it fits: what has been measured in it can be used again then.
void WoundNeighbourhood::choose_region(const Wound& former) {
  constexpr double least = 0.75, most = 1.5;  // margins
  if (!cells_.empty() && lies_inside(around(former, least * margin_), region_) && lies_inside(region_, around(former, most * margin_))) return;
  region_ = around(former, margin_);
  is_exposed_ = false;
}

/// Those that come into the box, and those beside it that a probe at a vertex in the box can meet.
void WoundNeighbourhood::choose_cells(const Tissue& tissue, const StateView& state) {
  const double reach = 2.0 * tracker_.boundary().membrane().probe_radius();
  chosen_.clear();
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    const int first = tissue.first_vertex(cell), count = tissue.vertex_count(cell);
    const auto [left, right] = std::ranges::minmax(state.x.subspan(first, count));
    const auto [bottom, top] = std::ranges::minmax(state.y.subspan(first, count));
    if (left <= region_.x_high + reach && right >= region_.x_low - reach && bottom <= region_.y_high + reach && top >= region_.y_low - reach)
      chosen_.push_back(cell);
  }
  if (chosen_ == cells_) return;
  cells_.swap(chosen_);
  forget_part();
}

const Tissue& WoundNeighbourhood::part(const Tissue& tissue) {
  if (cells_.empty()) return tissue;
  if (!part_) {
    part_ = tissue.subset(cells_);
    vertex_.clear();
    for (const int cell : cells_)
      for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) vertex_.push_back(v);
  }
  return *part_;
}

StateView WoundNeighbourhood::gather(const StateView& state) {
  if (cells_.empty()) return state;
  x_.resize(vertex_.size());
  y_.resize(vertex_.size());
  bool same = true;
  const auto take = [&same](double& own, double value) {
    same &= std::bit_cast<std::uint64_t>(own) == std::bit_cast<std::uint64_t>(value);
    own = value;
  };
  for (std::size_t k = 0; k < vertex_.size(); ++k) take(x_[k], state.x[vertex_[k]]), take(y_[k], state.y[vertex_[k]]);
  is_exposed_ = is_exposed_ && same;
  StateView view;
  view.x = x_, view.y = y_;
  return view;
}

/// Exposure is a pure function of the part and its positions, so it is measured only when one of them has changed since the
/// tracker did: captures look at the wound where a grid time has just looked at the exposure.
const Exposure& WoundNeighbourhood::expose(const Tissue& watched, const StateView& positions) {
  if (!is_exposed_) tracker_.expose(watched, positions, cells_.empty() ? std::nullopt : std::optional(region_));
  is_exposed_ = !cells_.empty();  // the positions of the whole tissue are not kept
  return tracker_.boundary().exposure();
}

void WoundNeighbourhood::look(const Tissue& tissue, const StateView& state) {
  const Tissue& watched = part(tissue);
  const StateView positions = gather(state);
  expose(watched, positions);
  wound_ = tracker_.update_exposed(watched, positions);
  scatter(tissue, tracker_.boundary().exposure().exposed);
  if (wound_ && !cells_.empty())
    for (int& v : wound_->boundary) v = vertex_[v];
  if (cells_.empty()) tracker_.release_memory();  // of the whole tissue
}

const std::optional<Wound>& WoundNeighbourhood::update(const Tissue& tissue, const StateView& state) {
  const std::optional<Wound> former = std::move(wound_);
  if (former) {
    choose_region(*former);
    choose_cells(tissue, state);
  } else {
    look_at_all();
  }
  look(tissue, state);
  if (cells_.empty()) return wound_;
  if (wound_ && lies_inside(around(*wound_, 0.5 * margin_), region_) && !tracker_.boundary().left_out_meets(former->outline))
    return wound_;
  look_at_all();
  tracker_.follow(*former);
  look(tissue, state);
  return wound_;
}

const std::vector<char>& WoundNeighbourhood::exposed(const Tissue& tissue, const StateView& state) {
  const Tissue& watched = part(tissue);
  scatter(tissue, expose(watched, gather(state)).exposed);
  if (cells_.empty()) tracker_.release_memory();  // of the whole tissue
  return exposed_;
}

void WoundNeighbourhood::look_around_wound(const Tissue& tissue, const StateView& state) {
  if (!cells_.empty() || !wound_) return;
  choose_region(*wound_);
  choose_cells(tissue, state);
}

bool WoundNeighbourhood::surely_uncovers_nobody(const Tissue& tissue, const StateView& state) {
  if (cells_.empty() || !part_) return false;
  gather(state);
  const Exposure& last = tracker_.boundary().exposure();
  if (last.exposed.size() != vertex_.size()) return false;
  const Tissue& watched = part(tissue);
  for (int cell = 0; cell < watched.cell_count(); ++cell) {
    MembraneSegment before = segment(watched, watched.end_vertex(cell) - 1);
    for (int v = watched.first_vertex(cell); v < watched.end_vertex(cell); ++v) {
      const MembraneSegment after = segment(watched, v);
      if (!last.exposed[v]) {
        const bool was_out = last.margin[v] == 0.0 && last.blocker[v] < 0;
        const bool is_out = x_[v] < region_.x_low || x_[v] > region_.x_high || y_[v] < region_.y_low || y_[v] > region_.y_high;
        if (!(was_out && is_out) && !surely_covered(watched, v, before, after, last.blocker[v])) return false;
      }
      before = after;
    }
  }
  return true;
}

MembraneSegment WoundNeighbourhood::segment(const Tissue& watched, int v) const {
  const int w = watched.next(v);
  const double ex = x_[w] - x_[v], ey = y_[w] - y_[v], length = std::sqrt(ex * ex + ey * ey);
  return {x_[v], y_[v], ex / length, ey / length, length, watched.cell_of(v)};
}

/// Whether segment s of the vertex's own cell is farther than this from it along the membrane, both ways round.
bool WoundNeighbourhood::far_along_membrane(const Tissue& watched, int v, int s, double distance) const {
  double ahead = 0.0, behind = 0.0;
  for (int w = v; w != s; w = watched.next(w)) ahead += segment(watched, w).length;
  for (int w = watched.next(s); w != v; w = watched.next(w)) behind += segment(watched, w).length;
  return ahead > distance && behind > distance;
}

/// By `blocker`, which blocked the vertex between these segments, or a segment beside it.
bool WoundNeighbourhood::surely_covered(const Tissue& watched, int v, const MembraneSegment& before, const MembraneSegment& after, int blocker) const {
  if (blocker < 0) return false;
  constexpr double rounding = 1e-6;
  const double radius = tracker_.boundary().membrane().probe_radius(), limit = radius * radius * (1.0 - rounding);
  const Point centre = probe_centre(before, after, radius);
  const bool own = watched.cell_of(blocker) == after.cell;
  const auto covers = [&](int a) {
    const int b = watched.next(a);
    const double ex = x_[b] - x_[a], ey = y_[b] - y_[a], wx = centre.x - x_[a], wy = centre.y - y_[a];
    const double t = std::min(std::max((wx * ex + wy * ey) / (ex * ex + ey * ey), 0.0), 1.0);
    const double dx = wx - t * ex, dy = wy - t * ey;
    return dx * dx + dy * dy < limit && !(own && !far_along_membrane(watched, v, a, own_bend(radius) * (1.0 + rounding)));
  };
  return covers(blocker) || covers(watched.previous(blocker)) || covers(watched.next(blocker));
}

const std::vector<char>& WoundNeighbourhood::scatter(const Tissue& tissue, const std::vector<char>& found) {
  if (cells_.empty()) return exposed_ = found;
  exposed_.assign(tissue.vertex_count(), 0);
  for (std::size_t k = 0; k < vertex_.size(); ++k) exposed_[vertex_[k]] = found[k];
  return exposed_;
}

}  // namespace suture
