// Finding and applying the events of a closure on the interpolant of the last step.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernels/aligned_buffer.hpp"
#include "simulate/exposure_watch.hpp"
#include "simulate/published_search.hpp"
#include "suture/integrate/integrator.hpp"
#include "suture/measure/wound_neighbourhood.hpp"
#include "suture/ode/purse_string_events.hpp"
#include "suture/physics/purse_string_operations.hpp"

namespace suture {

/// The vertices the string runs along: the exposed ones (counter-clockwise about the wound) and, at both ends of every
/// cell's run, `crevice_depth` more towards where the cell touches its neighbour.
std::vector<int> string_boundary(const Tissue& tissue, const std::vector<int>& exposed, int crevice_depth);

/// Decides when events are worth locating: while at most `storm_rate` tethers change per unit of time.
class StormGauge {
 public:
  StormGauge(EventHandling handling, double storm_rate) : handling_(handling), storm_rate_(storm_rate) {}
  bool on_grid(double t);
  void count(double t, int events);
  long storms() const { return storms_; }
  template <class Archive>
  void fields(Archive& archive) {
    archive(window_start_, in_window_, in_last_window_, storms_, storming_);
  }

 private:
  EventHandling handling_;
  double storm_rate_;
  double window_start_ = 0.0;
  long in_window_ = 0, in_last_window_ = 0, storms_ = 0;
  bool storming_ = false;
};

/// What has to happen at one instant.
struct DueEvents {
  double time = 0.0;
  std::vector<RingEvent> tethers;
  bool captures = false;  ///< exposed vertices are to be captured
};

class ClosureEvents {
 public:
  ClosureEvents(const Config& config, const Membrane& membrane, double start_time);

  /// The first event in the integrator's last step, which began at `state`.
  std::optional<DueEvents> find(const Integrator& integrator, const TissueState& state, WoundNeighbourhood& edge);
  /// The next time after t at which events are looked for, if it is known before the step; else infinity.
  double next_known(double t);
  /// Applies them to `state` (whose time and values are those of the event); true if anything changed.
  bool apply(const DueEvents& due, TissueState& state, WoundNeighbourhood& edge, std::vector<EventRecord>& log);
  long storms() const { return gauge_.storms(); }
  /// What the next events depend on, for checkpoints (byte_archive.hpp).
  template <class Archive>
  void fields(Archive& archive) {
    archive(start_, gauge_, exposure_, last_grid_, search_);
  }

 private:
  std::optional<DueEvents> locate(const Integrator& integrator, const TissueState& state, WoundNeighbourhood& edge);
  StateView watched_at(double t, const Integrator& integrator, const TissueState& start);
  std::optional<DueEvents> locate_tethers(const Integrator& integrator, const TissueState& state);
  std::optional<DueEvents> locate_captures(const Integrator& integrator, const TissueState& state, WoundNeighbourhood& edge);
  std::optional<DueEvents> on_grid(const Integrator& integrator, const TissueState& state, WoundNeighbourhood& edge);
  void make_room(std::size_t components);
  void watch(const TissueState& state, bool tethers, const WoundNeighbourhood& edge);
  std::optional<DueEvents> after_step(const Integrator& integrator, const TissueState& state);
  bool capture(TissueState& state, WoundNeighbourhood& edge, std::vector<EventRecord>& log);
  /// Whether captures on the grid depend on who is exposed.
  bool looks_at_exposure() const { return parameters_.capture && exposure_.settled(); }
  bool locates_captures(bool on_grid) const { return parameters_.capture && !on_grid && parameters_.event_handling != EventHandling::each_step; }
  double grid_time(long k) const { return start_ + static_cast<double>(k) * interval_; }

  PurseStringParameters parameters_;
  TetherThresholds thresholds_;
  double start_, interval_;
  StormGauge gauge_;
  PublishedSearch search_;    // for CaptureSearch::published
  ExposureWatch exposure_;
  long last_grid_ = 0;        // index of the last grid time looked at
  std::vector<int> watched_;  // components of y that are looked at
  AlignedBuffer room_;
  std::span<double> values_;  // y interpolated, in these components; what is not looked at takes no memory
};

}  // namespace suture
