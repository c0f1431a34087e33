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

void WoundNeighbourhood::look_at_all() {
  cells_.clear();
  part_.reset();
}

void WoundNeighbourhood::choose_cells(const Tissue& tissue, const StateView& state, const Region& region) {
  chosen_.clear();
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    Region box{infinity, -infinity, infinity, -infinity};
    for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) include(box, state.x[v], state.y[v]);
    if (box.x_low <= region.x_high && box.x_high >= region.x_low && box.y_low <= region.y_high && box.y_high >= region.y_low)
      chosen_.push_back(cell);
  }
  if (chosen_ == cells_) return;
  cells_.swap(chosen_);
  part_.reset();
}

WoundNeighbourhood::Region WoundNeighbourhood::around(const Wound& wound, double distance) {
  Region box{infinity, -infinity, infinity, -infinity};
  for (const Point& p : wound.outline) include(box, p.x, p.y);
  return {box.x_low - distance, box.x_high + distance, box.y_low - distance, box.y_high + distance};
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

void WoundNeighbourhood::look(const Tissue& tissue, const StateView& state) {
  const Tissue& watched = part(tissue);
  wound_ = tracker_.update(watched, gather(state));
  scatter(tissue, tracker_.boundary().exposure().exposed);
  if (wound_ && !cells_.empty())
    for (int& v : wound_->boundary) v = vertex_[v];
  if (cells_.empty()) tracker_.release_memory();  // of the whole tissue
}

const std::optional<Wound>& WoundNeighbourhood::update(const Tissue& tissue, const StateView& state) {
  const std::optional<Wound> former = std::move(wound_);
  Region region{};
  if (former) {
    region = around(*former, margin_);
    choose_cells(tissue, state, region);
  } else {
    look_at_all();
  }
  look(tissue, state);
  if (!former) return wound_;
  if (wound_) {
    const Region least = around(*wound_, 0.5 * margin_);
    if (least.x_low > region.x_low && least.x_high < region.x_high && least.y_low > region.y_low && least.y_high < region.y_high) return wound_;
  }
  look_at_all();
  tracker_.follow(*former);
  look(tissue, state);
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
