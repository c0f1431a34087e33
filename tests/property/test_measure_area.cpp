// The wound's area against an independent flood fill, its continuity, and its invariances, on random tissues.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "support/wound_tissues.hpp"
#include "suture/measure/wound.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// A star-shaped wound with deep bays, every vertex moved at random.
TissueState star(double noise, unsigned seed, double waist = 0.6) {
  const auto inner = [=](double angle) {
    return waist + 0.5 * (1.0 + std::cos(5.0 * angle)) * (0.8 + 0.2 * std::sin(angle));
  };
  TissueState state = tissue_of(sector_ring({.cells = 11,
                                             .inner = inner,
                                             .outer = [=](double angle) { return inner(angle) + 1.0; },
                                             .gap = 0.12,
                                             .inner_points = 20,
                                             .side_points = 8}));
  shake(state, noise, seed);
  return state;
}

TissueState random_wound(unsigned seed) {
  const double noise = 0.004 * (seed % 8);
  return seed % 2 ? star(0.5 * noise, seed) : wounded_honeycomb(noise, seed);
}

}  // namespace

TEST_CASE("the wound area agrees with a flood fill, the better the smaller the pixels", "[property]") {
  const Membrane m = default_membrane();
  int checked = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    const TissueState state = random_wound(seed);
    const auto wound = find_wound(state.tissue, state.view(), m);
    REQUIRE(wound);
    // Each of the two pixel tests displaces the edge by half a pixel at most; the open pixels' centres stop half a
    // pixel short of the true edge, so the count is biased low.
    double last = 1e9;
    for (const double pixel : {0.02, 0.01, 0.005}) {
      const double error = std::abs(flood_fill_area(state, m, wound->centre, pixel) - wound->area);
      CAPTURE(seed, pixel, error, wound->area);
      CHECK(error < 1.2 * pixel * wound->perimeter);
      CHECK(error < last);
      last = error;
      ++checked;
    }
  }
  CHECK(checked == 24);
}

TEST_CASE("the wound area moves no more than its edge, also when vertices change their exposure", "[property]") {
  const Membrane m = default_membrane();
  constexpr double motion = 2e-4;
  int toggles = 0, compared = 0;
  double worst = 0.0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    TissueState state = random_wound(seed);
    WoundTracker tracker(m);
    double last = tracker.update(state.tissue, state.view())->area;
    std::vector<char> flags = tracker.boundary().exposure().exposed;
    for (unsigned step = 0; step < 150; ++step) {
      shake(state, motion, 1000 * seed + step);
      const auto& wound = tracker.update(state.tissue, state.view());
      REQUIRE(wound);
      for (std::size_t v = 0; v < flags.size(); ++v) toggles += flags[v] != tracker.boundary().exposure().exposed[v];
      flags = tracker.boundary().exposure().exposed;
      const double jump = std::abs(wound->area - last);
      worst = std::max(worst, jump / (motion * std::sqrt(2.0) * wound->perimeter));
      last = wound->area;
      ++compared;
    }
  }
  CAPTURE(worst, toggles);
  CHECK(worst < 1.0);
  CHECK(toggles > 50);
  CHECK(compared == 900);
}

TEST_CASE("wound measures do not depend on place, direction or numbering", "[property]") {
  const Membrane m = default_membrane();
  for (unsigned seed = 0; seed < 10; ++seed) {
    const TissueState state = random_wound(seed);
    const auto wound = find_wound(state.tissue, state.view(), m);
    REQUIRE(wound);
    TissueState moved = state;
    move(moved, 0.7 + seed, 30.0, -12.0);
    const auto after = find_wound(moved.tissue, moved.view(), m);
    REQUIRE(after);
    CHECK(after->area == Approx(wound->area).epsilon(1e-10));
    CHECK(after->perimeter == Approx(wound->perimeter).epsilon(1e-10));
    REQUIRE(after->boundary.size() == wound->boundary.size());
    const auto rotated_to_first = [](std::vector<int> list, int first) {
      std::rotate(list.begin(), std::find(list.begin(), list.end(), first), list.end());
      return list;
    };
    CHECK(rotated_to_first(after->boundary, wound->boundary[0]) == wound->boundary);

    std::vector<int> new_vertex;
    const TissueState other = renumbered(state, seed, new_vertex);
    const auto same = find_wound(other.tissue, other.view(), m);
    REQUIRE(same);
    CHECK(same->area == Approx(wound->area).epsilon(1e-10));
    std::vector<int> expected;
    for (const int v : wound->boundary) expected.push_back(new_vertex[v]);
    REQUIRE(same->boundary.size() == expected.size());
    CHECK(rotated_to_first(same->boundary, expected[0]) == expected);
  }
}

TEST_CASE("lengths scale with the unit of length, areas with its square", "[property]") {
  const Membrane m = default_membrane();
  const double scale = 7.3;
  TissueState state = wounded_honeycomb(0.02, 4);
  const auto wound = find_wound(state.tissue, state.view(), m);
  for (double& value : state.values) value *= scale;
  const auto large = find_wound(state.tissue, state.view(), {scale * m.contact_distance, m.range});
  REQUIRE((wound && large));
  CHECK(large->area == Approx(scale * scale * wound->area).epsilon(1e-10));
  CHECK(large->perimeter == Approx(scale * wound->perimeter).epsilon(1e-10));
  CHECK(large->boundary == wound->boundary);
}
