#include "suture/ode/purse_string_events.hpp"

#include <utility>

#include "suture/physics/purse_string_operations.hpp"

namespace suture {

std::string_view to_string(EventKind kind) {
  switch (kind) {
    case EventKind::yield:
      return "yield";
    case EventKind::force_lost:
      return "force_lost";
    case EventKind::force_regained:
      return "force_regained";
    case EventKind::capture:
      return "capture";
    case EventKind::kink:
      return "kink";
    case EventKind::closed:
      return "closed";
    case EventKind::exchange:
      return "exchange";
    case EventKind::wound_split:
      return "wound_split";
  }
  return "unknown";
}

EventRecord event_record(const TissueState& state, EventKind kind, int vertex) {
  return {state.time, kind, state.tissue.cell_of(vertex), vertex};
}

TetherThresholds tether_thresholds(const PurseStringParameters& parameters, double contact_distance) {
  const double yield_length = parameters.yield_length * contact_distance;
  return {parameters.tether_law, 0.5 * yield_length, yield_length};
}

std::vector<RingEvent> due_events(const PurseString& purse_string, const StateView& state,
                                  const TetherThresholds& thresholds) {
  std::vector<RingEvent> due;
  const bool slips = thresholds.law == TetherLaw::saturating_energy;
  const auto first_point = state.rest_length.size();
  constexpr double clearly = 0.99;  // beyond what rounding could decide
  const double least = slips ? thresholds.half : thresholds.yield, harmless2 = clearly * least * least;
  for (int j = 0; j < purse_string.size(); ++j) {
    const bool attached = purse_string.mode[j] == TetherMode::attached;
    const int v = purse_string.vertex[j];
    const double dx = state.x[first_point + j] - state.x[v], dy = state.y[first_point + j] - state.y[v];
    if ((attached || !slips) && dx * dx + dy * dy < harmless2) continue;  // as nearly all are
    const double l = tether_length(purse_string, state, j);
    if (l >= thresholds.yield)
      due.push_back({EventKind::yield, j});
    else if (slips && attached && l >= thresholds.half)
      due.push_back({EventKind::force_lost, j});
    else if (slips && !attached && l < thresholds.half)
      due.push_back({EventKind::force_regained, j});
  }
  return due;
}

std::vector<RingEvent> watched_events(const PurseString& purse_string, const TetherThresholds& thresholds) {
  std::vector<RingEvent> watched;
  const bool slips = thresholds.law == TetherLaw::saturating_energy;
  for (int j = 0; j < purse_string.size(); ++j) {
    if (slips && purse_string.mode[j] == TetherMode::attached) {
      watched.push_back({EventKind::force_lost, j});
      continue;
    }
    watched.push_back({EventKind::yield, j});
    if (slips) watched.push_back({EventKind::force_regained, j});
  }
  return watched;
}

double event_function(const RingEvent& event, const PurseString& purse_string, const StateView& state,
                      const TetherThresholds& thresholds) {
  const double l = tether_length(purse_string, state, event.index);
  const double threshold = event.kind == EventKind::yield ? thresholds.yield : thresholds.half;
  const double excess = (l / threshold) * (l / threshold) - 1.0;
  return event.kind == EventKind::force_regained ? -excess : excess;
}

TissueState apply_events(TissueState state, std::span<const RingEvent> events, GapLaw law, std::vector<EventRecord>& log) {
  std::vector<int> yielded;
  for (const RingEvent& event : events) {
    log.push_back(event_record(state, event.kind, state.purse_string.vertex[event.index]));
    if (event.kind == EventKind::yield)
      yielded.push_back(event.index);
    else
      state.purse_string.mode[event.index] =
          event.kind == EventKind::force_lost ? TetherMode::slipped : TetherMode::attached;
  }
  return yield_tethers(std::move(state), yielded, law);
}

std::optional<double> next_kink_time(const PurseString& purse_string, double t) {
  std::optional<double> next;
  if (!(purse_string.shrink_rate > 0.0)) return next;
  for (int j = 0; j < purse_string.size(); ++j)
    if (const double kink = purse_string.kink_time(j); kink > t && (!next || kink < *next)) next = kink;
  return next;
}

}  // namespace suture
