#include "simulate/exposure_watch.hpp"

#include <algorithm>

#include "measure/exposure_probe.hpp"
#include "simulate/bracket.hpp"

namespace suture {

void ExposureWatch::settle(const std::vector<char>& exposed, double t) {
  seen_ = exposed;
  settled_at_ = t;
  std::erase_if(released_, [t](const ReleasedVertex& r) { return r.until <= t; });
  last_look_found_nobody_ = true;
}

bool ExposureWatch::is_held_back(int vertex, double t) const {
  return std::ranges::any_of(released_, [&](const ReleasedVertex& r) { return r.vertex == vertex && r.until > t; });
}

std::optional<double> ExposureWatch::next_release() const {
  const auto earliest = std::ranges::min_element(released_, {}, &ReleasedVertex::until);
  return earliest == released_.end() ? std::nullopt : std::optional(earliest->until);
}

bool ExposureWatch::find_newly_exposed(const Tissue& tissue, const StateView& state, WoundNeighbourhood& edge) {
  newly_exposed_.clear();
  if (last_look_found_nobody_ && edge.surely_uncovers_nobody(tissue, state)) return false;
  const std::vector<char>& exposed = edge.exposed(tissue, state);
  for (int v = 0; v < tissue.vertex_count(); ++v)
    if (exposed[v] && !seen_[v]) newly_exposed_.push_back(v);
  last_look_found_nobody_ = newly_exposed_.empty();
  return !last_look_found_nobody_;
}

std::optional<double> ExposureWatch::first_due(double low, double high, double resolution, const Tissue& tissue, const StateAt& state_at,
                                               WoundNeighbourhood& edge) {
  low = std::max(low, settled_at_);
  const std::optional<double> release = next_release();
  const bool released = release && *release <= high;
  if (released) high = std::max(low, *release);
  const StateView at_end = state_at(high);
  if (!find_newly_exposed(tissue, at_end, edge)) return released ? std::optional(high) : std::nullopt;
  ExposureProbe margin(tissue, at_end, membrane_, newly_exposed_, edge.cells());
  const double last = margin(at_end), first = margin(state_at(low));
  if (!(first < 0.0 && last >= 0.0)) return high;
  return first_not_negative(low, first, high, last, resolution, [&](double t) { return margin(state_at(t)); });
}

}  // namespace suture
