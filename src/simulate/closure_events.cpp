#include "simulate/closure_events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simulate/bracket.hpp"

namespace suture {

namespace {

constexpr double longest_without_look = 20.0;  // event intervals

void add_point(const StateLayout& layout, int point, std::vector<int>& components) {
  components.push_back(layout.x(point));
  components.push_back(layout.y(point));
}

/// The components of y that hold both ends of every tether.
void add_tethers(const TissueState& state, std::vector<int>& components) {
  const StateLayout layout = state.layout();
  for (int j = 0; j < layout.ring; ++j) {
    add_point(layout, layout.ring_point(j), components);
    add_point(layout, state.purse_string.vertex[j], components);
  }
}

double time_resolution(const Integrator& integrator) {
  return std::max(1e-6 * integrator.last_step(), 1e-12 * std::abs(integrator.time()));
}

}  // namespace

std::vector<int> string_boundary(const Tissue& tissue, const std::vector<int>& exposed, int crevice_depth) {
  std::vector<char> taken(tissue.vertex_count(), 0);
  for (const int v : exposed) taken[v] = 1;
  std::vector<int> boundary;
  const auto take = [&](int v) {
    if (std::exchange(taken[v], 1) == 0) boundary.push_back(v);
  };
  for (std::size_t k = 0; k < exposed.size(); ++k) {
    const int v = exposed[k], before = exposed[(k + exposed.size() - 1) % exposed.size()], after = exposed[(k + 1) % exposed.size()];
    if (before != tissue.next(v)) {  // a run begins: cells are passed in the direction of decreasing vertex number
      std::vector<int> lead{v};
      for (int d = 0; d < crevice_depth; ++d) lead.push_back(tissue.next(lead.back()));
      for (int d = crevice_depth; d >= 1; --d) take(lead[d]);
    }
    boundary.push_back(v);
    if (after != tissue.previous(v))
      for (int d = 0, w = v; d < crevice_depth; ++d) take(w = tissue.previous(w));
  }
  return boundary;
}

void StormGauge::count(double t, int events) {
  if (t - window_start_ >= 1.0) {
    in_last_window_ = t - window_start_ < 2.0 ? in_window_ : 0;
    in_window_ = 0;
    window_start_ = t;
  }
  in_window_ += events;
  const bool before = storming_;
  storming_ = static_cast<double>(std::max(in_window_, in_last_window_)) > storm_rate_;
  if (storming_ && !before) ++storms_;
}

bool StormGauge::on_grid(double t) {
  if (handling_ != EventHandling::automatic) return handling_ == EventHandling::grid;
  count(t, 0);
  return storming_;
}

ClosureEvents::ClosureEvents(const Config& config, const Membrane& membrane, double start_time)
    : parameters_(config.purse_string),
      thresholds_(tether_thresholds(config.purse_string, membrane.contact_distance)),
      start_(start_time),
      interval_(config.purse_string.event_interval),
      gauge_(config.purse_string.event_handling, config.purse_string.storm_rate),
      search_(membrane, config.purse_string.search_steps, config.purse_string.capture_steps),
      exposure_(membrane, longest_without_look * interval_) {}

/// The state in the components watched_, at a time inside the step that began at `start`.
StateView ClosureEvents::watched_at(double t, const Integrator& integrator, const TissueState& start) {
  if (t <= start.time) return start.view();
  if (t >= integrator.time()) return StateView(start.layout(), integrator.state());
  integrator.interpolate_some(t, watched_, values_);
  return StateView(start.layout(), values_);
}

/// Earliest crossing of the event function of a tether that has an event due at the end of the step. A tether that crosses and comes
/// back within one step is not an event: the step's own accuracy does not resolve it.
std::optional<DueEvents> ClosureEvents::locate_tethers(const Integrator& integrator, const TissueState& state) {
  const StateLayout layout = state.layout();
  const PurseString& string = state.purse_string;
  const double high = integrator.time(), low = state.time;
  const StateView at_end(layout, integrator.state());
  DueEvents due{high, due_events(string, at_end, thresholds_), false};
  if (due.tethers.empty()) return std::nullopt;
  if (parameters_.event_handling == EventHandling::each_step) return due;
  watched_.clear();
  add_tethers(state, watched_);
  const std::vector<RingEvent> at_high = due.tethers;
  const auto excess = [&](const StateView& view) {  // with the sign that due_events decides on
    double largest = -1.0;
    for (const RingEvent& event : at_high) largest = std::max(largest, event_function(event, string, view, thresholds_));
    return due_events(string, view, thresholds_).empty() ? std::min(largest, -std::numeric_limits<double>::min()) : std::max(largest, 0.0);
  };
  const double first = excess(state.view());
  const auto excess_at = [&](double t) { return excess(watched_at(t, integrator, state)); };
  due.time = first < 0.0 ? first_not_negative(low, first, high, excess(at_end), time_resolution(integrator), excess_at) : low;
  if (due.time < high) due.tethers = due_events(string, watched_at(due.time, integrator, state), thresholds_);
  return due;
}

std::optional<DueEvents> ClosureEvents::locate_captures(const Integrator& integrator, const TissueState& state, WoundNeighbourhood& edge) {
  if (!locates_captures(false) || !exposure_.settled()) return std::nullopt;
  watch(state, false, edge);
  const auto state_at = [&](double t) { return watched_at(t, integrator, state); };
  const std::optional<double> due = exposure_.first_due(state.time, integrator.time(), time_resolution(integrator), state.tissue, state_at, edge);
  return due ? std::optional(DueEvents{*due, {}, true}) : std::nullopt;
}

std::optional<DueEvents> ClosureEvents::locate(const Integrator& integrator, const TissueState& state, WoundNeighbourhood& edge) {
  std::optional<DueEvents> tethers = locate_tethers(integrator, state), captures = locate_captures(integrator, state, edge);
  if (!captures || (tethers && tethers->time < captures->time)) return tethers;
  return captures;
}

/// What looking for events reads of the state: the ends of the tethers, the positions of the cells around the wound.
void ClosureEvents::watch(const TissueState& state, bool tethers, const WoundNeighbourhood& edge) {
  watched_.clear();
  if (tethers) add_tethers(state, watched_);
  if (!looks_at_exposure()) return;
  const auto add_cell = [&](int cell) {
    for (int v = state.tissue.first_vertex(cell); v < state.tissue.end_vertex(cell); ++v) add_point(state.layout(), v, watched_);
  };
  for (const int cell : edge.cells()) add_cell(cell);
  if (edge.cells().empty())
    for (int cell = 0; cell < state.tissue.cell_count(); ++cell) add_cell(cell);
}

/// Events at the grid times inside the step: the last one is examined, and only if something is due there is the first
/// grid time at which it is looked for.
std::optional<DueEvents> ClosureEvents::on_grid(const Integrator& integrator, const TissueState& state, WoundNeighbourhood& edge) {
  const long last = static_cast<long>(std::floor((integrator.time() - start_) / interval_ + 1e-9));
  if (last <= last_grid_) return std::nullopt;
  const bool tethers = gauge_.on_grid(integrator.time());
  if (locates_captures(tethers) && exposure_.settled()) {
    last_grid_ = last;
    return std::nullopt;
  }
  watch(state, tethers, edge);
  const auto due_at = [&](long k) -> std::optional<DueEvents> {
    integrator.interpolate_some(std::min(grid_time(k), integrator.time()), watched_, values_);
    const StateView view(state.layout(), values_);
    DueEvents due{grid_time(k), {}, false};
    if (tethers) due.tethers = due_events(state.purse_string, view, thresholds_);
    due.captures = parameters_.capture && (exposure_.next_release() <= grid_time(k) || !(looks_at_exposure() && exposure_.is_as_seen(edge.exposed(state.tissue, view))));
    if (due.tethers.empty() && !due.captures) return std::nullopt;
    return due;
  };
  std::optional<DueEvents> due = due_at(last);
  if (due) {
    long low = last_grid_, high = last;  // nothing due at low
    while (high - low > 1) {
      const long middle = (low + high) / 2;
      if (std::optional<DueEvents> earlier = due_at(middle)) {
        high = middle;
        due = std::move(earlier);
      } else {
        low = middle;
      }
    }
    last_grid_ = high;
    due->time = std::min(due->time, integrator.time());
  } else {
    last_grid_ = last;
  }
  return due;
}

void ClosureEvents::make_room(std::size_t components) {
  room_ = {};  // before it is taken anew
  room_ = AlignedBuffer(components);
  values_ = {room_.take(components), components};
}

double ClosureEvents::next_known(double t) {
  if (!gauge_.on_grid(t)) return exposure_.next_release() > t ? exposure_.next_release() : 1e300;
  return grid_time(static_cast<long>(std::floor((t - start_) / interval_ + 1e-9)) + 1);
}

std::optional<DueEvents> ClosureEvents::find(const Integrator& integrator, const TissueState& state, WoundNeighbourhood& edge) {
  if (state.purse_string.empty()) return std::nullopt;
  if (parameters_.capture_search == CaptureSearch::published) return after_step(integrator, state);
  if (values_.size() != state.values.size()) make_room(state.values.size());
  std::optional<DueEvents> due = on_grid(integrator, state, edge);
  if (gauge_.on_grid(integrator.time())) return due;
  std::optional<DueEvents> located = locate(integrator, state, edge);
  if (!located || (due && due->time <= located->time)) return due;
  // The step is cut here, so the grid times behind it are looked at again.
  last_grid_ = std::min(last_grid_, static_cast<long>(std::floor((located->time - start_) / interval_ + 1e-9)));
  return located;
}

/// As the published program: whatever is due at the end of the step.
std::optional<DueEvents> ClosureEvents::after_step(const Integrator& integrator, const TissueState& state) {
  const StateView view(state.layout(), integrator.state());
  if (!search_.step(integrator.time(), state, view)) return std::nullopt;
  DueEvents due{integrator.time(), due_events(state.purse_string, view, thresholds_), false};
  due.captures = parameters_.capture && search_.offers_untethered(state.purse_string);
  if (due.tethers.empty() && !due.captures) return std::nullopt;
  return due;
}

/// Captures come first: a tether that breaks now is not made anew at the same instant.
bool ClosureEvents::apply(const DueEvents& due, TissueState& state, WoundNeighbourhood& edge, std::vector<EventRecord>& log) {
  std::vector<int> vertex;  // the events' cell vertices: ring indices move when vertices are captured
  for (const RingEvent& e : due.tethers) vertex.push_back(state.purse_string.vertex[e.index]);
  const bool located = locates_captures(gauge_.on_grid(due.time));  // before these events are counted
  bool changed = !due.tethers.empty();
  if (due.captures) changed |= capture(state, edge, log);
  std::vector<RingEvent> tethers = due.tethers;
  const std::vector<int>& ring = state.purse_string.vertex;
  for (std::size_t k = 0; k < tethers.size(); ++k)
    tethers[k].index = static_cast<int>(std::find(ring.begin(), ring.end(), vertex[k]) - ring.begin());
  state = apply_events(std::move(state), tethers, parameters_.gap_law, log);
  gauge_.count(due.time, static_cast<int>(tethers.size()));
  for (std::size_t k = 0; k < tethers.size(); ++k) {
    if (tethers[k].kind != EventKind::yield) continue;
    if (located)
      exposure_.release(vertex[k], due.time + interval_);
    else
      exposure_.unsettle();
  }
  if (state.purse_string.empty()) exposure_.forget();
  return changed;
}

bool ClosureEvents::capture(TissueState& state, WoundNeighbourhood& edge, std::vector<EventRecord>& log) {
  const CaptureRule rule{parameters_.capture_law, parameters_.law};
  if (parameters_.capture_search == CaptureSearch::published) return search_.capture(state, rule, log);
  const std::optional<Wound>& wound = edge.update(state.tissue, state.view());
  exposure_.settle(edge.exposed_at_update(), state.time);
  if (!wound) return false;
  std::vector<int> boundary = string_boundary(state.tissue, wound->boundary, parameters_.crevice_depth);
  std::erase_if(boundary, [&](int v) { return exposure_.is_held_back(v, state.time); });
  const std::vector<Capture> captured = captures(state, boundary);
  if (captured.empty()) return false;
  state = capture_vertices(std::move(state), captured, rule);
  for (const Capture& c : captured) log.push_back(event_record(state, EventKind::capture, c.vertex));
  return true;
}

}  // namespace suture
