#include <catch2/catch.hpp>
#include <set>

#include "suture/ode/purse_string_events.hpp"
#include "suture/physics/purse_string_tethers.hpp"
#include "unit/purse_string/ring_fixture.hpp"

using namespace suture;
using namespace suture::test;

namespace {

using Events = std::vector<RingEvent>;

TetherThresholds thresholds_of(TetherLaw law) {
  PurseStringParameters parameters = ring_parameters();
  parameters.tether_law = law;
  return tether_thresholds(parameters, contact_distance);
}

const double l_y = 2.0 * contact_distance;

}  // namespace

TEST_CASE("every kind of event has its own name", "[unit]") {
  std::set<std::string_view> names;
  for (const EventKind kind : {EventKind::yield, EventKind::force_lost, EventKind::force_regained, EventKind::capture,
                               EventKind::kink, EventKind::closed, EventKind::exchange, EventKind::wound_split})
    names.insert(to_string(kind));
  CHECK(names.size() == 8);
  CHECK(names.contains("force_regained"));
  CHECK_FALSE(names.contains("unknown"));
}

TEST_CASE("thresholds come from the yield length in contact distances", "[unit]") {
  const TetherThresholds thresholds = thresholds_of(TetherLaw::ramp);
  CHECK(thresholds.yield == Approx(l_y));
  CHECK(thresholds.half == Approx(l_y / 2));
  CHECK(thresholds.law == TetherLaw::ramp);
}

TEST_CASE("events are due where their conditions hold", "[unit]") {
  TissueState state = with_string(ring_parameters());
  CHECK(due_events(state.purse_string, state.view(), thresholds_of(TetherLaw::saturating_energy)).empty());
  stretch_tether(state, 1, 0.6 * l_y, 0.3);
  stretch_tether(state, 2, 0.6 * l_y, 1.3);
  stretch_tether(state, 3, 0.4 * l_y, 2.3);
  stretch_tether(state, 4, 0.4 * l_y, 3.3);
  stretch_tether(state, 5, 1.1 * l_y, 4.3);
  stretch_tether(state, 6, 1.1 * l_y, 5.3);
  for (const int j : {2, 4, 6}) state.purse_string.mode[j] = TetherMode::slipped;
  CHECK(
      due_events(state.purse_string, state.view(), thresholds_of(TetherLaw::saturating_energy)) ==
      Events{{EventKind::force_lost, 1}, {EventKind::force_regained, 4}, {EventKind::yield, 5}, {EventKind::yield, 6}});
  for (const TetherLaw law : {TetherLaw::saturating_force, TetherLaw::published, TetherLaw::ramp})
    CHECK(due_events(state.purse_string, state.view(), thresholds_of(law)) ==
          Events{{EventKind::yield, 5}, {EventKind::yield, 6}});
}

TEST_CASE("an event is due exactly when its function is not negative, and is watched before", "[unit]") {
  TissueState state = with_string(ring_parameters());
  const int j = 3;
  int agreements = 0;
  for (const TetherLaw law : {TetherLaw::saturating_energy, TetherLaw::ramp})
    for (const TetherMode mode : {TetherMode::attached, TetherMode::slipped}) {
      const TetherThresholds thresholds = thresholds_of(law);
      state.purse_string.mode[j] = mode;
      for (const double fraction : {0.0, 0.3, 0.499, 0.501, 0.9, 0.999, 1.001}) {
        const bool already_slipped =
            law == TetherLaw::saturating_energy && mode == TetherMode::attached && fraction > 1.0;
        if (already_slipped) continue;  // passes l_y/2 first
        stretch_tether(state, j, fraction * l_y, 0.9);
        Events crossed;
        for (const RingEvent& e : watched_events(state.purse_string, thresholds))
          if (event_function(e, state.purse_string, state.view(), thresholds) >= 0.0) crossed.push_back(e);
        CHECK(crossed == due_events(state.purse_string, state.view(), thresholds));
        agreements += !crossed.empty();
      }
    }
  CHECK(agreements == 9);
}

TEST_CASE("event functions are of order one and smooth at zero length", "[unit]") {
  TissueState state = with_string(ring_parameters());
  const TetherThresholds thresholds = thresholds_of(TetherLaw::saturating_force);
  CHECK(event_function({EventKind::yield, 0}, state.purse_string, state.view(), thresholds) == -1.0);
  stretch_tether(state, 0, std::sqrt(2.0) * l_y, 0.2);
  CHECK(event_function({EventKind::yield, 0}, state.purse_string, state.view(), thresholds) == Approx(1.0));
}

TEST_CASE("a tether slips, recovers and breaks", "[unit]") {
  PurseStringParameters parameters = ring_parameters();
  const TetherThresholds thresholds = thresholds_of(TetherLaw::saturating_energy);
  TissueState state = with_string(parameters);
  const int j = 2, vertex = state.purse_string.vertex[j], size = state.purse_string.size();
  std::vector<EventRecord> log;
  const auto force = [&] {
    return PurseStringTethers(state.tissue, state.purse_string, parameters, contact_distance).forces(state.view())[j];
  };
  const auto step_to = [&](double fraction) {
    stretch_tether(state, j, fraction * l_y, 0.4);
    state.time += 0.5;
    const Events due = due_events(state.purse_string, state.view(), thresholds);
    state = apply_events(std::move(state), due, GapLaw::span, log);
    CHECK((state.purse_string.size() < size || due_events(state.purse_string, state.view(), thresholds).empty()));
  };
  step_to(0.45);
  CHECK(force() == Approx(4.0 * 0.45 * l_y));
  step_to(0.55);
  CHECK(force() == 0.0);
  step_to(0.48);
  CHECK(force() == Approx(4.0 * 0.48 * l_y));
  step_to(0.7);
  CHECK(force() == 0.0);
  step_to(1.0001);
  CHECK(state.purse_string.size() == size - 1);
  const int cell = state.tissue.cell_of(vertex);
  CHECK(log == std::vector<EventRecord>{{3.5, EventKind::force_lost, cell, vertex},
                                        {4.0, EventKind::force_regained, cell, vertex},
                                        {4.5, EventKind::force_lost, cell, vertex},
                                        {5.0, EventKind::yield, cell, vertex}});
}

TEST_CASE("yields and changes of mode can fall due together", "[unit]") {
  TissueState state = with_string(ring_parameters());
  const std::vector<int> vertices = state.purse_string.vertex;
  std::vector<EventRecord> log;
  const Events events{{EventKind::yield, 1}, {EventKind::force_lost, 3}, {EventKind::yield, 4}};
  state = apply_events(std::move(state), events, GapLaw::span, log);
  REQUIRE(state.purse_string.size() == static_cast<int>(vertices.size()) - 2);
  CHECK(state.purse_string.vertex[2] == vertices[3]);
  CHECK(state.purse_string.mode[2] == TetherMode::slipped);
  REQUIRE(log.size() == 3);
  CHECK(log[2].vertex == vertices[4]);
  CHECK(log[2].cell == state.tissue.cell_of(vertices[4]));
}

TEST_CASE("nothing due means nothing changed and nothing allocated", "[unit]") {
  TissueState state = with_string(ring_parameters());
  const double* data = state.values.data();
  std::vector<EventRecord> log;
  const Events due = due_events(state.purse_string, state.view(), thresholds_of(TetherLaw::published));
  CHECK(due.capacity() == 0);
  state = apply_events(std::move(state), due, GapLaw::span, log);
  CHECK(state.values.data() == data);
  CHECK(log.empty());
}

TEST_CASE("rest lengths shrink to their floor and meet it at the kink", "[unit]") {
  const TissueState state = with_string(ring_parameters(SpringLaw::relative));
  const PurseString& ring = state.purse_string;
  double t = state.time;
  int kinks = 0;
  while (const std::optional<double> next = next_kink_time(ring, t)) {
    REQUIRE(*next > t);
    int at_floor = 0;
    for (int j = 0; j < ring.size(); ++j) {
      const double e = 1e-6;
      if (ring.kink_time(j) != *next) continue;
      ++at_floor;
      CHECK(ring.rest_length(j, *next) == Approx(ring.minimum_rest_length).epsilon(1e-12));
      CHECK(ring.rest_length(j, *next - e) == Approx(ring.minimum_rest_length + e * ring.shrink_rate).epsilon(1e-9));
      CHECK(ring.rest_length(j, *next + e) == ring.minimum_rest_length);
    }
    CHECK(at_floor >= 1);
    kinks += at_floor;
    t = *next;
  }
  CHECK(kinks == ring.size());
}

TEST_CASE("a string that does not contract has no kink", "[unit]") {
  TissueState state = with_string(ring_parameters());
  state.purse_string.shrink_rate = 0.0;
  CHECK_FALSE(next_kink_time(state.purse_string, state.time).has_value());
  CHECK_FALSE(next_kink_time(PurseString{}, 0.0).has_value());
}
