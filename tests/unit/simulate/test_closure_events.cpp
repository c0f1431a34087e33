// Turns that the string of a closure can take.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "support/event_log.hpp"
#include "support/setup_tissues.hpp"

using namespace suture;
using namespace suture::test;

namespace {

Config closing_config(Method method) {
  Config config = small_closing_config(method);
  config.run.end_time = 4.0;
  return config;
}

ClosureResult close(const Config& config, EventLog& log) {
  TissueState last_good;
  return run_closure(config, small_wound(config), log, last_good);
}

}  // namespace

TEST_CASE("a closure goes on when its string has broken altogether", "[unit]") {
  for (const Method method : {Method::rkc2, Method::cvode, Method::euler}) {
    Config config = closing_config(method);
    config.integrator.time_step = 0.002;
    config.purse_string.yield_length = 0.02;
    config.purse_string.constriction_rate = 200.0;
    EventLog log;
    const ClosureResult result = close(config, log);
    CAPTURE(static_cast<int>(method));
    CHECK(result.status == ClosureStatus::reached_end);
    CHECK(log.count(EventKind::yield) > 3);
    CHECK(result.state.purse_string.empty());
    CHECK(log.records.back().time < result.state.time - 2.0);
  }
}

TEST_CASE("without captures none happen, located or on the grid", "[unit]") {
  for (const EventHandling handling : {EventHandling::located, EventHandling::grid}) {
    Config config = closing_config(Method::rkc2);
    config.purse_string.yield_length = 0.5;
    config.purse_string.capture = false;
    config.purse_string.event_handling = handling;
    EventLog log;
    close(config, log);
    CHECK(log.count(EventKind::yield) > 3);
    CHECK(log.count(EventKind::capture) == 0);
  }
}

TEST_CASE("a vertex that is held back is so when a storm begins, too", "[unit]") {
  int captures = 0;
  for (const double storm_rate : {1.0, 4.0, 12.0}) {
    Config config = closing_config(Method::rkc2);
    config.purse_string.yield_length = 0.5;
    config.purse_string.storm_rate = storm_rate;
    config.purse_string.event_interval = 0.05;
    EventLog log;
    const ClosureResult result = close(config, log);
    CHECK(result.storms > 0);
    // On the grid a tether is made anew at the next grid time at the earliest; one that broke outside a storm waits for a whole interval.
    std::map<int, double> broke;
    double first = 1e300;
    for (const EventRecord& e : log.records) {
      if (e.kind == EventKind::yield) broke[e.vertex] = e.time;
      if (e.kind == EventKind::capture && broke.contains(e.vertex)) first = std::min(first, e.time - broke[e.vertex]), ++captures;
    }
    CAPTURE(storm_rate, first);
    CHECK(first > 0.05 - 1e-9);
  }
  CHECK(captures > 20);
}
