// The discrete events of a closure: which are due, when the next may come, and the record kept of each.
//
// The purse string is a hybrid system (model.md section 5): between events the ring and the tethers' modes are fixed
// and the rate is smooth; at an event they change and the integrator restarts. The tethers' events are crossings of
//
//     yield            l >= l_y                            every law; the tether and its purse-string vertex vanish
//     force_lost       l >= l_y/2, tether attached         saturating_energy only: mode becomes slipped
//     force_regained   l <  l_y/2, tether slipped          saturating_energy only: mode becomes attached
//
// The kink of a rest length (lambda0 reaching its floor) is known in advance: next_kink_time.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "suture/model/state.hpp"

namespace suture {

enum class EventKind {
  yield,           ///< a tether broke
  force_lost,      ///< a tether passed l_y/2 and carries no force (saturating_energy)
  force_regained,  ///< and came back
  capture,         ///< a newly exposed vertex was tethered
  kink,            ///< a chain spring reached its shortest rest length
  closed,          ///< the wound is closed
  exchange,        ///< cells exchanged neighbours
  wound_split,     ///< the wound fell into parts
};

/// "yield", "force_lost", ...
std::string_view to_string(EventKind kind);

/// One line of the event log.
struct EventRecord {
  double time = 0.0;
  EventKind kind = EventKind::yield;
  int cell = -1;    ///< -1 when the event concerns the whole wound
  int vertex = -1;  ///< cell vertex, tissue-wide index; -1 when the event concerns no single vertex
  friend bool operator==(const EventRecord&, const EventRecord&) = default;
};

/// Record of `kind` at cell vertex `vertex`, at state.time.
EventRecord event_record(const TissueState& state, EventKind kind, int vertex);

/// An event of ring vertex `index` (of kind yield, force_lost or force_regained).
struct RingEvent {
  EventKind kind = EventKind::yield;
  int index = 0;
  friend bool operator==(const RingEvent&, const RingEvent&) = default;
};

/// The lengths at which tethers change, model units.
struct TetherThresholds {
  TetherLaw law = TetherLaw::saturating_energy;
  double half = 0.0;   ///< l_y/2
  double yield = 0.0;  ///< l_y
};
TetherThresholds tether_thresholds(const PurseStringParameters& parameters, double contact_distance);

/// The events whose condition holds at `state`, in ring order; at most one per tether, yield before a change of mode.
/// Touches the ring only; allocates nothing when nothing is due.
std::vector<RingEvent> due_events(const PurseString& purse_string, const StateView& state,
                                  const TetherThresholds& thresholds);

/// The events that can come next, given the modes: what a root finder watches until the ring changes. An attached
/// tether of saturating_energy loses its force before it can yield, so only that is watched.
std::vector<RingEvent> watched_events(const PurseString& purse_string, const TetherThresholds& thresholds);

/// Event function of one watched event: negative before, zero or positive once it is due; smooth in the positions,
/// (l/l_threshold)^2 - 1 or its negative, hence of order 1. A root is bracketed from its negative side; restart at the
/// end of the bracket where due_events lists the event.
double event_function(const RingEvent& event, const PurseString& purse_string, const StateView& state,
                      const TetherThresholds& thresholds);

/// Applies ring events at state.time, all yields at once, and appends a record of each to `log`.
TissueState apply_events(TissueState state, std::span<const RingEvent> events, GapLaw law, std::vector<EventRecord>& log);

/// Earliest time > t at which a rest length reaches its floor; nothing if all have or none ever will.
std::optional<double> next_kink_time(const PurseString& purse_string, double t);

}  // namespace suture
