// Turns that the string of a closure can take.
#include <catch2/catch.hpp>

#include <algorithm>
#include <map>

#include "support/setup_tissues.hpp"
#include "suture/setup/protocol.hpp"
#include "suture/simulate/closure.hpp"

using namespace suture;
using namespace suture::test;

namespace {

class EventLog final : public ClosureObserver {
 public:
  void sample(const ClosureSample&) override {}
  void event(const EventRecord& e) override { records.push_back(e); }
  long count(EventKind kind) const {
    return std::ranges::count_if(records, [=](const EventRecord& e) { return e.kind == kind; });
  }
  std::vector<EventRecord> records;
};

Config closing_config(Method method) {
  Config config = with_contact_distance(small_config());
  config.run.end_time = 4.0;
  config.run.closed_area = 1e-3;
  config.plasticity.tau = 3.0;
  config.integrator.method = method;
  return config;
}

const TissueState& wounded() {
  static const TissueState state = [] {
    Config config = small_config();
    config.run.last_stage = Stage::ablation;
    return prepare_tissue(config).state;
  }();
  return state;
}

ClosureResult close(const Config& config, EventLog& log) {
  TissueState state = wounded(), last_good;
  const Tissue configured = make_tissue(config);
  state.tissue = state.tissue.with_materials(std::vector<CellMaterial>(state.tissue.cell_count(), configured.material(0)));
  return run_closure(config, std::move(state), log, last_good);
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
