#include "simulate/exposure_watch.hpp"

#include <algorithm>
#include <limits>
#include <span>

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

double ExposureWatch::next_release() const {
  double next = std::numeric_limits<double>::infinity();
  for (const ReleasedVertex& r : released_) next = std::min(next, r.until);
  return next;
}

bool ExposureWatch::find_newly_exposed(const Tissue& tissue, const StateView& state, WoundNeighbourhood& edge) {
  newly_exposed_.clear();
  edge.look_around_wound(tissue, state);
  if (last_look_found_nobody_ && edge.surely_uncovers_nobody(tissue, state)) return false;
  const std::vector<char>& exposed = edge.exposed(tissue, state);
  for (int v = 0; v < tissue.vertex_count(); ++v)
    if (exposed[v] && !seen_[v]) newly_exposed_.push_back(v);
  last_look_found_nobody_ = newly_exposed_.empty();
  return !last_look_found_nobody_;
}

/// One that was exposed at `low` already has only come into the region that is looked at.
double ExposureWatch::first_exposed(double low, double high, double resolution, const Tissue& tissue, const StateAt& state_at,
                                    const WoundNeighbourhood& edge) {
  const auto probe = [&](std::span<const int> vertices) { return ExposureProbe(tissue, state_at(high), membrane_, vertices, edge.cells()); };
  ExposureProbe margin = probe(newly_exposed_);
  double first = margin(state_at(low));
  if (!(first < 0.0)) {
    std::erase_if(newly_exposed_, [&](int v) { return probe({&v, 1})(state_at(low)) >= 0.0; });
    if (newly_exposed_.empty()) return high;
    margin = probe(newly_exposed_);
    first = margin(state_at(low));
  }
  return first_not_negative(low, first, high, margin(state_at(high)), resolution, [&](double t) { return margin(state_at(t)); });
}

std::optional<double> ExposureWatch::first_due(double low, double high, double resolution, const Tissue& tissue, const StateAt& state_at,
                                               WoundNeighbourhood& edge) {
  low = std::max(low, settled_at_);
  const double known = std::min(next_release(), settled_at_ + patience_);
  const bool due = known <= high;
  if (due) high = std::max(low, known);
  if (find_newly_exposed(tissue, state_at(high), edge)) return first_exposed(low, high, resolution, tissue, state_at, edge);
  return due ? std::optional(high) : std::nullopt;
}

}  // namespace suture
