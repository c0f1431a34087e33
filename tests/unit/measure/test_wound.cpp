#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "support/wound_tissues.hpp"
#include "suture/measure/wound.hpp"

using namespace suture;
using namespace suture::test;

namespace {

constexpr double pi = std::numbers::pi;

/// Distance from the centre of the sides of a regular polygon of this apothem.
double regular(double apothem, int sides, double angle) {
  const double sector = 2.0 * pi / sides;
  return apothem / std::cos(angle - sector * (std::floor(angle / sector) + 0.5));
}

/// A ring of `sides` cells around a hole that is a regular polygon.
TissueState polygonal_ring(double apothem, int sides = 8, double gap = 0.02) {
  return tissue_of(sector_ring({.cells = sides,
                                .inner = [=](double angle) { return regular(apothem, sides, angle); },
                                .outer = [=](double) { return apothem + 1.0; },
                                .gap = gap}));
}

/// A ring around a peanut-shaped hole whose waist is 2 neck wide; `skew` makes the right half larger.
TissueState peanut(double neck, double skew = 0.0) {
  const auto inner = [=](double angle) {
    const double c = std::cos(angle);
    return neck + (1.2 + skew * c) * c * c;
  };
  return tissue_of(sector_ring({.cells = 10,
                                .inner = inner,
                                .outer = [=](double a) { return inner(a) + 1.0; },
                                .gap = 0.08,
                                .inner_points = 25}));
}

double delta(const Membrane& m) { return m.probe_radius() - m.half_width(); }

}  // namespace

TEST_CASE("the wound area of a regular polygon is exact", "[unit]") {
  const Membrane m = default_membrane();
  for (const int sides : {5, 8, 13})
    for (const double apothem : {0.5, 1.3}) {
      const TissueState state = polygonal_ring(apothem, sides);
      const auto wound = find_wound(state.tissue, state.view(), m);
      REQUIRE(wound);
      const double inner = apothem - m.probe_radius(), d = delta(m), t = sides * std::tan(pi / sides);
      CHECK(wound->area == Approx(t * inner * inner + 2.0 * t * inner * d + pi * d * d).epsilon(1e-12));
      CHECK(wound->perimeter == Approx(2.0 * t * inner + 2.0 * pi * d).epsilon(1e-12));
      CHECK(signed_area(wound->outline) == Approx(wound->area).epsilon(2e-3));
      CHECK(std::hypot(wound->centre.x, wound->centre.y) < 1e-9);
      CHECK(wound->parts == 1);
      CHECK(wound->area_of_parts == wound->area);
    }
}

TEST_CASE("the wound boundary lists each cell's exposed vertices, counter-clockwise about the wound", "[unit]") {
  const TissueState state = polygonal_ring(1.0);
  const auto wound = find_wound(state.tissue, state.view(), default_membrane());
  REQUIRE(wound);
  REQUIRE(wound->boundary.size() >= 8 * 8);
  Polygon polygon;
  for (const int v : wound->boundary) polygon.push_back({state.view().x[v], state.view().y[v]});
  CHECK(signed_area(polygon) > 2.5);
  CHECK(std::set<int>(wound->boundary.begin(), wound->boundary.end()).size() == wound->boundary.size());
  int same_cell = 0, changes = 0;
  for (std::size_t i = 0; i < wound->boundary.size(); ++i) {
    const int a = wound->boundary[i], b = wound->boundary[(i + 1) % wound->boundary.size()];
    if (state.tissue.cell_of(a) != state.tissue.cell_of(b)) {
      ++changes;
      continue;
    }
    CHECK(b == state.tissue.previous(a));
    ++same_cell;
  }
  CHECK(changes == 8);
  CHECK(same_cell >= 8 * 7);
}

TEST_CASE("a cell that shows a single vertex keeps its place in the boundary", "[unit]") {
  // A wedge between sectors 0 and 7 whose tip reaches the wound.
  auto cells =
      sector_ring({.cells = 7, .inner = [](double) { return 1.0; }, .outer = [](double) { return 2.0; }, .gap = 0.44});
  cells.push_back({{0.98, 0.0}, {1.25, -0.07}, {1.9, -0.07}, {1.9, 0.07}, {1.25, 0.07}});
  const TissueState state = tissue_of(cells);
  const auto wound = find_wound(state.tissue, state.view(), {.contact_distance = 0.4, .range = 0.3});
  REQUIRE(wound);
  const int tip = state.tissue.first_vertex(7);
  const auto place = std::find(wound->boundary.begin(), wound->boundary.end(), tip);
  REQUIRE(place != wound->boundary.end());
  const auto count = std::count_if(wound->boundary.begin(), wound->boundary.end(),
                                   [&](int v) { return state.tissue.cell_of(v) == 7; });
  CHECK(count == 1);
  const auto i = static_cast<std::size_t>(place - wound->boundary.begin());
  const std::size_t n = wound->boundary.size();
  CHECK(state.tissue.cell_of(wound->boundary[(i + n - 1) % n]) == 6);
  CHECK(state.tissue.cell_of(wound->boundary[(i + 1) % n]) == 0);
}

TEST_CASE("cracks are sealed and the rim is not a wound", "[unit]") {
  const Membrane m = default_membrane();
  const TissueState whole = tissue_of(honeycomb({}));
  CHECK_FALSE(find_wound(whole.tissue, whole.view(), m));
  FreeBoundary boundary(m);
  boundary.evaluate(whole.tissue, whole.view());
  REQUIRE(boundary.loops().size() == 1);
  CHECK_FALSE(boundary.loops()[0].is_hole());
  CHECK(boundary.loops()[0].vertices.size() > 100);

  const TissueState wounded = wounded_honeycomb();
  CHECK(find_wound(wounded.tissue, wounded.view(), m)->area == Approx(4.586).epsilon(1e-3));
}

TEST_CASE("walls exactly as far apart as the probe is wide are no trouble", "[unit]") {
  const Membrane m = default_membrane();
  const auto ablated = [](Point p) { return std::hypot(p.x, p.y) < 1.2; };
  FreeBoundary boundary(m);
  int checked = 0;
  for (const double factor : {1.0, 1.0 + 1e-15, 1.0 - 1e-15})
    for (const double angle : {0.0, 0.3, 1.1}) {
      TissueState state = tissue_of(honeycomb({.gap = 2.0 * m.probe_radius() * factor, .removed = ablated}));
      move(state, angle, 0.1, 0.2);
      boundary.evaluate(state.tissue, state.view());
      CHECK(boundary.largest_gap() < 1e-6);
      const auto wound = find_wound(boundary);
      REQUIRE(wound);
      CHECK(wound->area == Approx(8.2798).epsilon(1e-3));
      ++checked;
    }
  CHECK(checked == 9);
}

TEST_CASE("of two holes the larger is the wound, unless the other was", "[unit]") {
  const Membrane m = default_membrane();
  const TissueState state = tissue_of(honeycomb({.removed = [](Point p) {
    return std::hypot(p.x, p.y) < 0.1 || std::hypot(p.x - 2.3, p.y) < 0.1 || std::hypot(p.x - 3.45, p.y) < 0.1;
  }}));
  FreeBoundary boundary(m);
  boundary.evaluate(state.tissue, state.view());
  const auto wound = find_wound(boundary);
  REQUIRE(wound);
  CHECK(wound->centre.x > 2.0);
  const std::vector<double> holes = hole_areas(boundary);
  REQUIRE(holes.size() == 2);
  CHECK(holes[0] == wound->area);
  Wound former;
  former.outline = {{-0.3, -0.3}, {0.3, -0.3}, {0.0, 0.3}};
  const auto followed = find_wound(boundary, &former);
  REQUIRE(followed);
  CHECK(std::abs(followed->centre.x) < 0.01);
  CHECK(followed->area == Approx(holes[1]));
  CHECK(followed->parts == 1);
}

TEST_CASE("an island of tissue inside the wound is not wound", "[unit]") {
  const Membrane m = default_membrane();
  auto cells = sector_ring({.cells = 12, .inner = [](double) { return 2.0; }, .outer = [](double) { return 3.0; }});
  const TissueState ring = tissue_of(cells);
  Polygon island;
  for (int i = 0; i < 24; ++i) island.push_back({0.5 * std::cos(2 * pi * i / 24), 0.5 * std::sin(2 * pi * i / 24)});
  cells.push_back(island);
  const TissueState both = tissue_of(cells);
  const auto without = find_wound(ring.tissue, ring.view(), m), with = find_wound(both.tissue, both.view(), m);
  REQUIRE((with && without));
  const double half = m.half_width();
  const double taken = signed_area(island) + perimeter(island) * half + pi * half * half;
  CHECK(without->area - with->area == Approx(taken).epsilon(1e-10));
  CHECK(with->area == Approx(flood_fill_area(both, m, {1.2, 0.0}, 0.005)).epsilon(0.02));
}

TEST_CASE("a narrow wound splits and its larger part is followed", "[unit]") {
  const Membrane m = default_membrane();
  WoundTracker tracker(m);
  double last = 0.0, last_parts = 0.0;
  int steps = 0;
  for (double neck = 0.15; neck > 0.05; neck -= 0.0005, ++steps) {
    const TissueState state = peanut(neck, 0.1);
    const auto& wound = tracker.update(state.tissue, state.view());
    REQUIRE(wound);
    CAPTURE(neck, wound->area, last);
    if (wound->parts > 1) {
      CHECK(wound->parts == 2);
      CHECK(wound->centre.x > 0.3);
      CHECK(wound->area < 0.7 * last);
      CHECK(wound->area_of_parts == Approx(last_parts).margin(0.02));
    } else if (last > 0.0) {
      CHECK(std::abs(wound->area - last) < 0.01);
    }
    last = wound->area, last_parts = wound->area_of_parts;
  }
  CHECK(steps > 100);
  CHECK(tracker.splits() == 1);
  CHECK(tracker.status() == WoundStatus::open);
}

TEST_CASE("a wound closes to a point", "[unit]") {
  const Membrane m = default_membrane();
  WoundTracker tracker(m);
  const double smallest = pi * delta(m) * delta(m);
  CHECK(tracker.status() == WoundStatus::absent);
  double last = 1e9;
  for (double apothem = 0.5; apothem > m.probe_radius() + 2e-5; apothem -= 2e-3) {
    const TissueState state = polygonal_ring(apothem, 5);
    const auto& wound = tracker.update(state.tissue, state.view());
    REQUIRE(wound);
    CHECK(wound->area < last);
    CHECK(wound->area > smallest);
    last = wound->area;
  }
  CHECK(last < smallest + 1e-3);
  const TissueState state = polygonal_ring(m.probe_radius() - 1e-4, 5, 0.0);
  CHECK_FALSE(tracker.update(state.tissue, state.view()));
  CHECK(tracker.status() == WoundStatus::closed);
  const TissueState reopened = polygonal_ring(0.5, 5);
  CHECK_FALSE(tracker.update(reopened.tissue, reopened.view()));
}

TEST_CASE("a wound that breaks through the rim is not called closed", "[unit]") {
  WoundTracker tracker(default_membrane());
  auto cells = sector_ring({.cells = 8, .inner = [](double) { return 1.0; }, .outer = [](double) { return 2.0; }});
  const TissueState ring = tissue_of(cells);
  CHECK(tracker.update(ring.tissue, ring.view()));
  cells.erase(cells.begin());
  const TissueState broken = tissue_of(cells);
  CHECK_FALSE(tracker.update(broken.tissue, broken.view()));
  CHECK(tracker.status() == WoundStatus::open_to_outside);
}

TEST_CASE("the strict rule lists fewer vertices, in the same order", "[unit]") {
  const TissueState state = wounded_honeycomb(0.03, 5);
  WoundTracker probe(default_membrane()), strict(default_membrane(), ExposureRule::contact_free);
  const auto all = probe.update(state.tissue, state.view())->boundary;
  const auto some = strict.update(state.tissue, state.view())->boundary;
  CHECK(some.size() < all.size());
  REQUIRE(some.size() > 30);
  auto place = all.begin();
  for (const int v : some) {
    place = std::find(place, all.end(), v);
    REQUIRE(place != all.end());
  }
}
