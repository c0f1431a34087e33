// Exposure and the free boundary against brute force and against each other, on random tissues.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "support/wound_tissues.hpp"
#include "suture/measure/free_boundary.hpp"

using namespace suture;
using namespace suture::test;

namespace {

Polygon corners(const BoundingBox& b) { return {{b.x_low, b.y_low}, {b.x_high, b.y_low}, {b.x_high, b.y_high}, {b.x_low, b.y_high}}; }

TissueState random_tissue(unsigned seed) { return wounded_honeycomb(0.003 * (seed % 13), seed); }

/// Distance from p to the nearest membrane of another cell, looking at every segment.
double distance_to_others(const TissueState& state, int cell, Point p) {
  const StateView view = state.view();
  double least = std::numeric_limits<double>::infinity();
  for (int v = 0; v < state.tissue.vertex_count(); ++v) {
    if (state.tissue.cell_of(v) == cell) continue;
    const int w = state.tissue.next(v);
    const Polygon segment{{view.x[v], view.y[v]}, {view.x[w], view.y[w]}};
    least = std::min(least, squared_distance_to_outline(segment, p));
  }
  return std::sqrt(least);
}

Point vertex(const TissueState& state, int v) { return {state.view().x[v], state.view().y[v]}; }

Point outward_normal(const TissueState& state, int v) {
  const Point a = vertex(state, state.tissue.previous(v)), b = vertex(state, v),
              c = vertex(state, state.tissue.next(v));
  const double in = std::hypot(b.x - a.x, b.y - a.y), out = std::hypot(c.x - b.x, c.y - b.y);
  const Point n{(b.y - a.y) / in + (c.y - b.y) / out, -(b.x - a.x) / in - (c.x - b.x) / out};
  const double norm = std::hypot(n.x, n.y);
  return {n.x / norm, n.y / norm};
}

}  // namespace

TEST_CASE("exposure agrees with looking at every segment", "[property]") {
  const Membrane m = default_membrane();
  const double rho = m.probe_radius();
  int exposed = 0, hidden = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const TissueState state = random_tissue(3 * seed + 1);
    const Exposure probe = exposed_vertices(state.tissue, state.view(), m);
    const Exposure strict = exposed_vertices(state.tissue, state.view(), m, ExposureRule::contact_free);
    for (int v = 0; v < state.tissue.vertex_count(); ++v) {
      const int cell = state.tissue.cell_of(v);
      const Point n = outward_normal(state, v), p = vertex(state, v);
      const double d = distance_to_others(state, cell, {p.x + rho * n.x, p.y + rho * n.y});
      // Noise folds no cell onto itself here, so other cells decide.
      REQUIRE(static_cast<bool>(probe.exposed[v]) == (d >= rho));
      CHECK(static_cast<bool>(strict.exposed[v]) == (distance_to_others(state, cell, p) > m.interaction_distance()));
      if (strict.exposed[v]) CHECK(probe.exposed[v]);
      if (probe.exposed[v]) CHECK(probe.margin[v] <= d - rho + 1e-12);
      if (!probe.exposed[v]) CHECK((probe.margin[v] < 0.0 && probe.margin[v] >= d - rho - 1e-12));
      (probe.exposed[v] ? exposed : hidden) += 1;
    }
  }
  CHECK(exposed > 500);
  CHECK(hidden > 2000);
}

TEST_CASE("a vertex keeps its exposure while nothing moves farther than its margin allows", "[property]") {
  const Membrane m = default_membrane();
  int kept = 0, changed = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    TissueState state = random_tissue(seed + 3);
    const Exposure before = exposed_vertices(state.tissue, state.view(), m);
    const double amplitude = 1e-3, moved = amplitude * std::sqrt(2.0);
    double shortest = std::numeric_limits<double>::infinity();
    for (int v = 0; v < state.tissue.vertex_count(); ++v) {
      const Point a = vertex(state, v), b = vertex(state, state.tissue.next(v));
      shortest = std::min(shortest, std::hypot(b.x - a.x, b.y - a.y));
    }
    shake(state, amplitude, seed);
    const Exposure after = exposed_vertices(state.tissue, state.view(), m);
    // Membranes move by `moved`; the disc's centre by that and by the turn of its normal, 2 moved/shortest at most.
    const double bound = 2.0 * moved + m.probe_radius() * 2.0 * moved / shortest * 1.1;
    for (std::size_t v = 0; v < before.margin.size(); ++v) {
      changed += before.exposed[v] != after.exposed[v];
      if (std::abs(before.margin[v]) < bound) continue;
      CHECK(before.exposed[v] == after.exposed[v]);
      ++kept;
    }
  }
  CHECK(kept > 5000);
  CHECK(changed > 20);
}

TEST_CASE("the pieces of the free boundary always join into closed loops", "[property]") {
  const Membrane m = default_membrane();
  FreeBoundary boundary(m);
  int loops = 0, holes = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    const TissueState state = random_tissue(seed);
    boundary.evaluate(state.tissue, state.view());
    CAPTURE(seed);
    CHECK(boundary.largest_gap() < 1e-6);
    std::set<int> seen;
    for (const BoundaryLoop& loop : boundary.loops()) {
      ++loops;
      holes += loop.is_hole();
      CHECK(loop.length * loop.length >= 4.0 * std::numbers::pi * std::abs(loop.signed_area) * (1.0 - 1e-12));
      for (const int v : loop.vertices) {
        CHECK(boundary.exposure().exposed[v]);
        CHECK(seen.insert(v).second);
      }
    }
    long exposed = 0;
    for (const char flag : boundary.exposure().exposed) exposed += flag;
    // Strong noise folds cells into pockets that no probe enters from outside.
    const bool folded = seed % 13 > 4;
    CHECK(static_cast<double>(seen.size()) >= (folded ? 0.93 : 1.0) * static_cast<double>(exposed));
  }
  CHECK(loops > 500);
  CHECK(holes > 300);
}

TEST_CASE("in a box the same loops are found, bit for bit, but for those that leave it", "[property]") {
  const Membrane m = default_membrane();
  FreeBoundary whole(m), part(m);
  int found = 0, vertices = 0, left_out = 0, hidden = 0, only_its_box = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const TissueState state = random_tissue(seed);
    const StateView view = state.view();
    whole.evaluate(state.tissue, view);
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> edge(0.5, 4.0);
    const BoundingBox box{-edge(engine), edge(engine), -edge(engine), edge(engine)};
    part.expose(state.tissue, view, box);
    part.trace(state.tissue, view);
    CAPTURE(seed);
    const auto inside = [&](const BoundingBox& b, double by) {
      return b.x_low - by > box.x_low && b.x_high + by < box.x_high && b.y_low - by > box.y_low && b.y_high + by < box.y_high;
    };
    for (int v = 0; v < state.tissue.vertex_count(); ++v) {
      const bool watched = inside({view.x[v], view.x[v], view.y[v], view.y[v]}, 0.0);
      CHECK(part.exposure().exposed[v] == (watched && whole.exposure().exposed[v]));
      hidden += !watched && whole.exposure().exposed[v];
    }
    const auto same = [](const BoundaryLoop& a, const BoundaryLoop& b) { return a.signed_area == b.signed_area && a.length == b.length; };
    for (const BoundaryLoop& loop : part.loops())
      CHECK(std::ranges::any_of(whole.loops(), [&](const BoundaryLoop& other) { return same(loop, other); }));
    for (const BoundaryLoop& loop : whole.loops()) {
      const BoundingBox around = bounding_box(loop.outline);
      const auto there = std::ranges::find_if(part.loops(), [&](const BoundaryLoop& other) { return same(loop, other); });
      constexpr double longest = 0.35;  // a segment here and the probe's radius
      if (inside(around, longest)) {
        REQUIRE(there != part.loops().end());
        CHECK(there->vertices == loop.vertices);
        ++found, vertices += static_cast<int>(loop.vertices.size());
      } else if (there == part.loops().end() && std::ranges::any_of(loop.outline, [&](Point p) { return inside({p.x, p.x, p.y, p.y}, longest); })) {
        CHECK(part.left_out_meets(corners(box)));
        ++left_out;
      }
    }
    // What is in the box around an outline, but far from it, does not count.
    std::vector<Point> left;
    for (const BoundaryLoop& loop : whole.loops())
      if (std::ranges::none_of(part.loops(), [&](const BoundaryLoop& other) { return same(loop, other); }))
        left.insert(left.end(), loop.outline.begin(), loop.outline.end());
    for (int k = 0; k < 40; ++k) {
      const double x = -edge(engine), y = -edge(engine), arm = 2.0 * edge(engine), width = 0.05;
      const Polygon angle{{x, y}, {x + arm, y}, {x + arm, y + width}, {x + width, y + width}, {x + width, y + arm}, {x, y + arm}};
      constexpr double far = 0.7;  // a segment, the probe's radius, half a membrane, and the distance between points of an outline
      const auto meets = [&](Point p) { return contains(angle, p) || squared_distance_to_outline(angle, p) < far * far; };
      if (std::ranges::any_of(left, meets)) continue;
      CHECK_FALSE(part.left_out_meets(angle));
      only_its_box += std::ranges::any_of(left, [&](Point p) { return p.x > x && p.x < x + arm && p.y > y && p.y < y + arm; });
    }
    whole.expose(state.tissue, view);
    whole.trace(state.tissue, view);
    CHECK_FALSE(whole.left_out_meets(corners({-1e9, 1e9, -1e9, 1e9})));
  }
  CHECK(found > 100);
  CHECK(vertices > 500);
  CHECK(left_out > 50);
  CHECK(hidden > 1000);
  CHECK(only_its_box > 20);
}

TEST_CASE("every loop keeps its distance from every cell", "[property]") {
  const Membrane m = default_membrane();
  FreeBoundary boundary(m);
  int points = 0;
  for (unsigned seed = 5; seed < 13; seed += 4) {
    const TissueState state = random_tissue(seed);
    boundary.evaluate(state.tissue, state.view());
    for (const BoundaryLoop& loop : boundary.loops())
      for (std::size_t i = 0; i < loop.outline.size(); i += 3) {
        // Arc chords cut inside by less than 0.004 s; every other outline point is at s/2 or farther.
        CHECK(distance_to_others(state, -1, loop.outline[i]) >= m.half_width() - 1e-9);
        ++points;
      }
  }
  CHECK(points > 100);
}
