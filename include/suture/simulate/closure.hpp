// The closure stage: a wounded tissue with a purse string, integrated as a hybrid system until the wound is closed.
//
// Between events the ring and the modes of its tethers are fixed and the rate is smooth. Events are located by root finding
// on the integrator's own interpolant, or processed on the event grid while they storm. A tether that breaks is made anew
// purse_string.event_interval later at the earliest (on the grid: at the next grid time), so no instant can repeat for ever.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suture/integrate/integrator.hpp"
#include "suture/measure/wound.hpp"
#include "suture/model/parameters.hpp"
#include "suture/model/state.hpp"
#include "suture/ode/purse_string_events.hpp"
#include "suture/setup/step_watch.hpp"

namespace suture {

/// One sample of a running closure, at a multiple of output.interval.
struct ClosureSample {
  const TissueState& state;          ///< at the sample's time
  const std::optional<Wound>& wound; ///< empty: no hole (any more)
  double time = 0.0;                 ///< since the purse string started
  double last_step = 0.0;
  int last_order = 0;
  Statistics statistics;             ///< so far
};

/// Watches a closure; cannot alter it.
class ClosureObserver {
 public:
  virtual ~ClosureObserver() = default;
  virtual void sample(const ClosureSample& sample) = 0;
  virtual void event(const EventRecord& record) = 0;
  /// Asked after every step; true ends the stage early.
  virtual bool stop() { return false; }
  /// Asked after every step: save, although no configured checkpoint is due?
  virtual bool checkpoint_due() { return false; }
  /// saved: what resume_closure() goes on from; everything observed so far belongs to it.
  virtual void checkpoint(const std::string& saved, double time, SavePoint point) { (void)saved, (void)time, (void)point; }
};

enum class ClosureStatus { closed, reached_end, stopped, opened };

struct ClosureResult {
  TissueState state;                 ///< at the end
  ClosureStatus status = ClosureStatus::reached_end;
  std::optional<double> t_closed;    ///< since the purse string started; when the area fell below run.closed_area
  Statistics statistics;
  long storms = 0;                   ///< times the events went from being located to the grid
};

/// Puts the purse string on the wound of `state` (unless purse_string.enabled is false) and integrates for run.end_time
/// or until the wound is closed. state.time is kept as the simulation's clock. Throws NumericalError when there is no
/// wound or the integration fails; `last_good` then holds the last consistent state.
ClosureResult run_closure(const Config& config, TissueState state, ClosureObserver& observer, TissueState& last_good);

/// Goes on from what ClosureObserver::checkpoint was given, under the same configuration. Throws FileError when `saved`
/// makes no sense.
ClosureResult resume_closure(const Config& config, const std::string& saved, ClosureObserver& observer,
                             TissueState& last_good);

}  // namespace suture
