// A whole embryo closure, from packing to the last gap, under the printed equations.
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <map>

#include "suture/io/config.hpp"
#include "suture/measure/closure.hpp"
#include "suture/measure/wound_neighbourhood.hpp"
#include "suture/setup/protocol.hpp"
#include "suture/simulate/closure.hpp"
#include "support/wound_tissues.hpp"

using namespace suture;

namespace {

/// Checks the wound area at every sample and keeps the curve.
class AreaWatch final : public ClosureObserver {
 public:
  explicit AreaWatch(const Membrane& membrane) : membrane_(membrane), whole_tissue_(membrane), neighbourhood_(membrane) {}

  void sample(const ClosureSample& s) override {
    const double area = s.wound ? s.wound->area : 0.0;
    series.time.push_back(s.time);
    series.area.push_back(area);
    if (s.wound && series.time.size() % 40 == 1) compare_with_flood_fill(s, area);
    compare_with_whole_tissue(s);
    if (s.wound && previous_parts_ == 1 && s.wound->parts == 1) check_continuity(s, area);
    previous_parts_ = s.wound ? s.wound->parts : 0;
    previous_ = s.state;
    previous_area_ = area;
    // The shape of every cell stays that of a polygon: positive area, everything finite.
    for (const double v : s.state.values) finite = finite && std::isfinite(v);
  }
  void event(const EventRecord& record) override {
    ++events[record.kind];
    // The time of closing is interpolated between the last two samples, and other events may have come after it.
    const double slack = record.kind == EventKind::closed ? sample_interval : 1e-9;
    in_order = in_order && record.time >= last_event_ - slack;
    last_event_ = record.time;
  }

  WoundSeries series;
  std::map<EventKind, int> events;
  int flood_fills = 0, continuity_checks = 0;
  double sample_interval = 0.0;
  bool finite = true, in_order = true;
  std::size_t fewest_cells = 1000;

 private:
  void compare_with_flood_fill(const ClosureSample& s, double area) {
    const double pixel = 0.01;
    const double counted = test::flood_fill_area(s.state, membrane_, s.wound->centre, pixel);
    if (counted == 0.0) return;  // the centre of a crooked wound may lie in a cell
    CAPTURE(s.time, area, counted, s.wound->perimeter);
    CHECK(std::abs(area - counted) < 1.5 * pixel * s.wound->perimeter + pixel * pixel);
    ++flood_fills;
  }
  /// Looking only at the cells around the wound, as the closure does, gives the same wound as the whole tissue, bit for bit.
  void compare_with_whole_tissue(const ClosureSample& s) {
    const std::optional<Wound>& seen = whole_tissue_.update(s.state.tissue, s.state.view());
    CAPTURE(s.time);
    REQUIRE(seen.has_value() == s.wound.has_value());
    if (!seen) return;
    CHECK(seen->area == s.wound->area);
    CHECK(seen->boundary == s.wound->boundary);
    neighbourhood_.update(s.state.tissue, s.state.view());
    if (!neighbourhood_.cells().empty()) fewest_cells = std::min(fewest_cells, neighbourhood_.cells().size());
    const std::vector<char> on_the_way = neighbourhood_.exposed_at_update();
    CHECK(on_the_way == neighbourhood_.exposed(s.state.tissue, s.state.view()));
  }
  /// The area cannot change faster than its edge moves.
  void check_continuity(const ClosureSample& s, double area) {
    double moved = 0.0;
    const StateView now = s.state.view(), before = previous_.view();
    for (int v = 0; v < s.state.tissue.vertex_count(); ++v)
      moved = std::max(moved, std::hypot(now.x[v] - before.x[v], now.y[v] - before.y[v]));
    CAPTURE(s.time, area, previous_area_, moved, s.wound->perimeter);
    CHECK(std::abs(area - previous_area_) < moved * s.wound->perimeter + 0.05);
    ++continuity_checks;
  }

  Membrane membrane_;
  WoundTracker whole_tissue_;
  WoundNeighbourhood neighbourhood_;
  TissueState previous_;
  double previous_area_ = 0.0, last_event_ = 0.0;
  int previous_parts_ = 0;
};

/// Keeps the curve only.
class AreaSeries final : public ClosureObserver {
 public:
  int yields = 0;
  void sample(const ClosureSample& s) override {
    series.time.push_back(s.time);
    series.area.push_back(s.wound ? s.wound->area : 0.0);
  }
  void event(const EventRecord& record) override { yields += record.kind == EventKind::yield; }
  WoundSeries series;
};

}  // namespace

TEST_CASE("an embryo wound closes, and its area is what a flood fill counts", "[validation][slow]") {
  Config config = with_contact_distance(default_config());
  config.run.closed_area = 0.05;
  config.run.end_time = 2000.0;  // the published end; the last percent of a single, chaotic closure may take its time
  const Preparation prepared = prepare_tissue(config);
  REQUIRE(prepared.acceptance.accepted);
  AreaWatch watch(make_membrane(config.contact, prepared.state.tissue));
  watch.sample_interval = config.output.interval;
  TissueState last_good;
  const ClosureResult result = run_closure(config, prepared.state, watch, last_good);
  CHECK(result.status == ClosureStatus::closed);
  CHECK(watch.flood_fills >= 5);
  CHECK(watch.continuity_checks >= 100);
  CHECK(watch.finite);
  CHECK(watch.fewest_cells < 20);
  CHECK(watch.in_order);
  CHECK(watch.events[EventKind::yield] > 100);
  CHECK(watch.events[EventKind::capture] > 100);
  CHECK(watch.events[EventKind::kink] > 0);
  CHECK(watch.events[EventKind::closed] == 1);
}

TEST_CASE("four embryo wounds close on average as published", "[validation][slow]") {
  // One closure is chaotic: its t_05 scatters by 30 % between seeds and, for one seed, between any two roundings. A mean
  // of four scatters by 15 %; the ensemble of 25 is in docs/validation. Published means of 25 seeds (data/published,
  // fig4): 33, 68, 101, 121 after the string starts.
  constexpr int seeds = 4;
  std::array<double, 4> mean{};
  for (int seed = 1; seed <= seeds; ++seed) {
    Config config = with_contact_distance(default_config());
    config.tissue.seed = seed;
    config.run.closed_area = 0.25;
    config.run.end_time = 400.0;
    AreaSeries watch;
    TissueState last_good;
    run_closure(config, prepare_tissue(config).state, watch, last_good);
    const ClosureSummary s = summarise_closure(watch.series);
    CAPTURE(seed);
    REQUIRE(s.t_05.has_value());
    mean[0] += *s.t_50 / seeds, mean[1] += *s.t_25 / seeds, mean[2] += *s.t_10 / seeds, mean[3] += *s.t_05 / seeds;
  }
  constexpr std::array published{33.0, 68.0, 101.0, 121.0};
  for (std::size_t k = 0; k < published.size(); ++k) {
    CAPTURE(k, mean[k], published[k]);
    CHECK(mean[k] == Approx(published[k]).epsilon(0.3));
  }
}

TEST_CASE("the same configuration gives the same closure, bit for bit", "[validation]") {
  Config config = with_contact_distance(default_config());
  config.run.end_time = 3.0;
  config.packing.force_tolerance = 1e-3;
  config.anneal.relaxation_time = config.wound.relaxation_time = 10.0;
  config.wound.maximum_hole = 10.0;
  std::vector<std::vector<double>> ends;
  for (int repeat = 0; repeat < 2; ++repeat) {
    const Preparation prepared = prepare_tissue(config);
    AreaWatch watch(make_membrane(config.contact, prepared.state.tissue));
    TissueState last_good;
    ends.push_back(run_closure(config, prepared.state, watch, last_good).state.values);
  }
  REQUIRE(!ends[0].empty());
  CHECK(ends[0] == ends[1]);
}

TEST_CASE("located and gridded events agree while events are rare", "[validation]") {
  Config config = with_contact_distance(default_config());
  config.purse_string.tether_law = TetherLaw::ramp;
  config.purse_string.yield_length = 1.4;
  config.run.end_time = 6.0;
  const Preparation prepared = prepare_tissue(config);
  std::map<EventHandling, double> area;
  for (const EventHandling handling : {EventHandling::located, EventHandling::grid}) {
    config.purse_string.event_handling = handling;
    config.purse_string.event_interval = 0.02;
    AreaWatch watch(make_membrane(config.contact, prepared.state.tissue));
    TissueState last_good;
    run_closure(config, prepared.state, watch, last_good);
    area[handling] = watch.series.area.back();
    CAPTURE(watch.series.area.front(), area[handling]);
    CHECK(area[handling] < 0.995 * watch.series.area.front());  // the string has pulled: 1 to 4 % in different tissues
  }
  CHECK(area[EventHandling::located] == Approx(area[EventHandling::grid]).epsilon(0.01));
}

TEST_CASE("how often events are looked for does not decide how often tethers break", "[validation][slow]") {
  // Ten embryos to t = 300: 249, 243, 231, 238, 258 yields with 0.2, 0.1, 0.05, 0.025, 0.0125; with the tension raised at
  // captures 1340, 1948, 3121, 4350, 4692 (docs/figures/fig4.md). Two to t = 40 here.
  Config config = with_contact_distance(default_config());
  config.run.end_time = 40.0;
  config.integrator.method = Method::automatic;
  config.purse_string.event_handling = EventHandling::grid;
  std::map<CaptureLaw, std::array<int, 2>> yields;
  for (int seed = 1; seed <= 2; ++seed) {
    config.tissue.seed = seed;
    const Preparation prepared = prepare_tissue(config);
    for (const CaptureLaw law : {CaptureLaw::tension_kept, CaptureLaw::split})
      for (const int k : {0, 1}) {
        config.purse_string.capture_law = law;
        config.purse_string.event_interval = k == 0 ? 0.2 : 0.025;
        AreaSeries watch;
        TissueState last_good;
        run_closure(config, prepared.state, watch, last_good);
        yields[law][k] += watch.yields;
      }
  }
  const auto ratio = [&](CaptureLaw law) { return static_cast<double>(yields[law][1]) / yields[law][0]; };
  CAPTURE(yields[CaptureLaw::tension_kept][0], yields[CaptureLaw::split][0]);
  REQUIRE(yields[CaptureLaw::tension_kept][0] > 50);
  INFO(ratio(CaptureLaw::tension_kept) << " " << ratio(CaptureLaw::split));
  CHECK(ratio(CaptureLaw::tension_kept) == Approx(1.0).epsilon(0.35));
  CHECK(ratio(CaptureLaw::split) > 2.0);
}
