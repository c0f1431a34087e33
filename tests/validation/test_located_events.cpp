// Events that are located in time: runs that are accurate enough have the same ones, and a tether that broke comes back when it may.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>

#include "support/event_log.hpp"
#include "support/integration.hpp"
#include "suture/io/config.hpp"
#include "suture/setup/protocol.hpp"

using namespace suture;
using namespace suture::test;

namespace {

struct Run {
  TissueState end;
  EventLog log;
};

Run run(Config config, const TissueState& start, Method method, double tolerance) {
  config.integrator.method = method;
  config.integrator.tolerance = config.integrator.rest_length_tolerance = tolerance;
  Run result;
  TissueState last_good;
  result.end = run_closure(config, start, result.log, last_good).state;
  return result;
}

/// Of the cells' vertices, rms.
double difference(const TissueState& a, const TissueState& b) {
  const std::size_t n = a.tissue.vertex_count();
  return std::hypot(rms_difference(a.view().x.first(n), b.view().x.first(n)), rms_difference(a.view().y.first(n), b.view().y.first(n))) / std::sqrt(2.0);
}

}  // namespace

TEST_CASE("accurate runs of two methods take the same way through the first hundred events", "[validation][slow]") {
  // Of 40 runs by five methods at 1e-4 and 1e-5 one had another number of events, and none was farther than 0.005 l0 from the reference
  // (docs/convergence.md): an event that goes two ways is rare, not impossible. With captures on the grid 6 of these 12 stray.
  Config config = with_contact_distance(default_config());
  config.run.end_time = 12.0;
  int events = 0, runs = 0, strayed = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    config.tissue.seed = seed;
    const TissueState start = prepare_tissue(config).state;
    const double l0 = start.tissue.mean_initial_rest_length();
    const Run reference = run(config, start, Method::rkc2, 1e-6);
    for (const auto& [method, tolerance] : {std::pair{Method::cvode, 1e-5}, std::pair{Method::cvode, 1e-4}, std::pair{Method::rkc2, 1e-4}}) {
      const Run other = run(config, start, method, tolerance);
      const double error = difference(other.end, reference.end) / l0;
      bool same = error < 0.01;
      for (const EventKind kind : {EventKind::yield, EventKind::capture, EventKind::force_lost})
        same = same && other.log.count(kind) == reference.log.count(kind);
      UNSCOPED_INFO("seed " << seed << ", tolerance " << tolerance << ", error " << error << " l0, same way: " << same);
      ++runs;
      strayed += !same;
    }
    events += static_cast<int>(reference.log.records.size());
  }
  CHECK(runs == 12);
  CHECK(strayed <= 2);
  CHECK(events > 400);
}

TEST_CASE("a vertex whose tether broke is captured again after the event interval, not before", "[validation]") {
  Config config = with_contact_distance(default_config());
  config.run.end_time = 30.0;
  config.purse_string.event_interval = 0.3;
  const TissueState start = prepare_tissue(config).state;
  for (const Method method : {Method::cvode, Method::rkc2}) {
    const Run result = run(config, start, method, 1e-3);
    std::map<int, double> broke;
    int at_once = 0, later = 0;
    for (const EventRecord& e : result.log.records) {
      if (e.kind == EventKind::yield) broke[e.vertex] = e.time;
      if (e.kind != EventKind::capture || !broke.contains(e.vertex)) continue;
      const double waited = e.time - broke[e.vertex];
      CAPTURE(e.vertex, e.time, waited);
      CHECK(waited >= 0.3 - 1e-9);
      ++(waited < 0.3 + 1e-9 ? at_once : later);
    }
    CAPTURE(static_cast<int>(method), at_once, later);
    CHECK(at_once > 20);
  }
}
