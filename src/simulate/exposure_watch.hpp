// Who is exposed to the wound, as far as captures are concerned: who was when they were last settled, when somebody else is, and
// which vertices may not be captured yet.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "suture/measure/wound_neighbourhood.hpp"
#include "suture/model/state.hpp"

namespace suture {

/// A vertex whose tether broke: it is not captured before `until`.
struct ReleasedVertex {
  int vertex = 0;
  double until = 0.0;
};

template <class Archive>
void exchange_fields(Archive& archive, ReleasedVertex& r) {
  archive(r.vertex, r.until);
}

class ExposureWatch {
 public:
  /// patience: captures are settled anew after so long at the latest. What only covers vertices asks for nothing, but the wound may have
  /// split by it, or a vertex that could not be captured when it was exposed may be exposed in another place.
  ExposureWatch(const Membrane& membrane, double patience) : membrane_(membrane), patience_(patience) {}

  /// Captures are settled at t, when these vertices are exposed.
  void settle(const std::vector<char>& exposed, double t);
  /// Captures are due whoever is exposed. So they are at first: that spares a new closure, whose wound has not been followed yet, a
  /// look at the whole tissue.
  void unsettle() { seen_.clear(); }
  /// There is no string any more.
  void forget() { seen_.clear(), released_.clear(); }
  bool settled() const { return !seen_.empty(); }
  bool is_as_seen(const std::vector<char>& exposed) const { return exposed == seen_; }

  void release(int vertex, double until) { released_.push_back({vertex, until}); }
  bool is_held_back(int vertex, double t) const;
  /// When the next of them may be captured; infinity if there is none.
  double next_release() const;

  /// Positions of the cells that `edge` looks at, at a time inside the step.
  using StateAt = std::function<StateView(double)>;
  /// The first time in (low, high] at which a vertex is exposed that was not when captures were settled, at most
  /// next_release() and the end of patience. A vertex that is exposed and covered again inside the step is not seen: the step's own accuracy
  /// does not resolve it.
  std::optional<double> first_due(double low, double high, double resolution, const Tissue& tissue, const StateAt& state_at, WoundNeighbourhood& edge);

  template <class Archive>
  void fields(Archive& archive) {
    archive(seen_, released_, settled_at_);
    if constexpr (Archive::reading) last_look_found_nobody_ = false;
  }

 private:
  double first_exposed(double low, double high, double resolution, const Tissue& tissue, const StateAt& state_at, const WoundNeighbourhood& edge);
  bool find_newly_exposed(const Tissue& tissue, const StateView& state, WoundNeighbourhood& edge);

  Membrane membrane_;
  double patience_;
  std::vector<char> seen_;  // exposed when captures were last settled; empty: they are not
  std::vector<ReleasedVertex> released_;
  double settled_at_ = -1e300;
  std::vector<int> newly_exposed_;
  bool last_look_found_nobody_ = false;  // the last look of `edge`
};

}  // namespace suture
