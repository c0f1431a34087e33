#include "simulate/published_search.hpp"

#include <algorithm>
#include <utility>

#include "suture/physics/purse_string_operations.hpp"

namespace suture {

/// The flood fill starts in the middle of the string.
void PublishedSearch::start(const TissueState& state, const StateView& view) {
  cells_.assign(static_cast<std::size_t>(state.tissue.cell_count()), 0);
  Point centre{0.0, 0.0};
  const double count = state.purse_string.size();
  for (const int v : state.purse_string.vertex) {
    cells_[state.tissue.cell_of(v)] = 1;
    centre.x += view.x[v] / count;
    centre.y += view.y[v] / count;
  }
  wound_.set_seed(centre);
}

bool PublishedSearch::step(double t, const TissueState& state, const StateView& view) {
  if (t == last_time_) return false;
  last_time_ = t;
  if (cells_.empty()) start(state, view);
  if (++steps_ % fill_interval_ != 0) return true;
  wound_.update(state.tissue, view);
  vertices_.clear();
  for (int v = 0; v < state.tissue.vertex_count(); ++v)
    if (cells_[state.tissue.cell_of(v)] && wound_.beside(view, v)) vertices_.push_back(v);
  return true;
}

bool PublishedSearch::offers_untethered(const PurseString& string) const {
  return steps_ % offer_interval_ == 0 && std::any_of(vertices_.begin(), vertices_.end(), [&](int v) {
    return std::find(string.vertex.begin(), string.vertex.end(), v) == string.vertex.end();
  });
}

bool PublishedSearch::capture(TissueState& state, const CaptureRule& rule, std::vector<EventRecord>& log) const {
  bool any = false;
  for (const int v : vertices_) {
    const std::vector<int>& ring = state.purse_string.vertex;
    if (std::find(ring.begin(), ring.end(), v) != ring.end()) continue;
    const std::optional<int> after = published_insertion(state, v);
    if (!after) continue;
    state = capture_vertices(std::move(state), {{v, *after}}, rule);
    log.push_back(event_record(state, EventKind::capture, v));
    any = true;
  }
  return any;
}

}  // namespace suture
