#include "suture/measure/wound_neighbourhood.hpp"

#include <algorithm>

namespace suture {

namespace {

template <class Region>
void include(Region& box, double x, double y) {
  box.x_low = std::min(box.x_low, x), box.x_high = std::max(box.x_high, x);
  box.y_low = std::min(box.y_low, y), box.y_high = std::max(box.y_high, y);
}

constexpr double infinity = 1e300;

}  // namespace

WoundNeighbourhood::WoundNeighbourhood(const Membrane& membrane, double margin)
    : margin_(margin), tracker_(membrane), exposure_(membrane) {}

void WoundNeighbourhood::choose_cells(const Tissue& tissue, const StateView& state) {
  region_ = around_outline(margin_);
  cells_.clear();
  part_.reset();
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    Region box{infinity, -infinity, infinity, -infinity};
    for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) include(box, state.x[v], state.y[v]);
    if (box.x_low <= region_.x_high && box.x_high >= region_.x_low && box.y_low <= region_.y_high && box.y_high >= region_.y_low)
      cells_.push_back(cell);
  }
}

WoundNeighbourhood::Region WoundNeighbourhood::around_outline(double distance) const {
  Region box{infinity, -infinity, infinity, -infinity};
  for (const Point& p : wound_->outline) include(box, p.x, p.y);
  return {box.x_low - distance, box.x_high + distance, box.y_low - distance, box.y_high + distance};
}

/// Too small once the outline is within half a margin of its edge, too large when it is twice what is needed.
bool WoundNeighbourhood::region_fits() const {
  const Region least = around_outline(0.5 * margin_), wanted = around_outline(margin_);
  const auto size = [](const Region& r) { return (r.x_high - r.x_low) * (r.y_high - r.y_low); };
  return least.x_low > region_.x_low && least.x_high < region_.x_high && least.y_low > region_.y_low && least.y_high < region_.y_high &&
         size(region_) < 2.0 * size(wanted);
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
  for (std::size_t k = 0; k < vertex_.size(); ++k) x_[k] = state.x[vertex_[k]], y_[k] = state.y[vertex_[k]];
  StateView view;
  view.x = x_, view.y = y_;
  return view;
}

const std::optional<Wound>& WoundNeighbourhood::update(const Tissue& tissue, const StateView& state) {
  const Tissue& watched = part(tissue);
  wound_ = tracker_.update(watched, gather(state));
  scatter(tissue, tracker_.boundary().exposure().exposed);
  if (!wound_) return wound_;
  if (!cells_.empty())
    for (int& v : wound_->boundary) v = vertex_[v];
  if (cells_.empty()) tracker_.release_memory();  // of the whole tissue
  if (cells_.empty() || !region_fits()) choose_cells(tissue, state);
  return wound_;
}

const std::vector<char>& WoundNeighbourhood::exposed(const Tissue& tissue, const StateView& state) {
  const Tissue& watched = part(tissue);
  return scatter(tissue, exposure_(watched, gather(state)).exposed);
}

const std::vector<char>& WoundNeighbourhood::scatter(const Tissue& tissue, const std::vector<char>& found) {
  if (cells_.empty()) return exposed_ = found;
  exposed_.assign(tissue.vertex_count(), 0);
  for (std::size_t k = 0; k < vertex_.size(); ++k) exposed_[vertex_[k]] = found[k];
  return exposed_;
}

}  // namespace suture
