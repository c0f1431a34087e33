#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "support/wound_tissues.hpp"
#include "suture/errors.hpp"
#include "suture/measure/exposure.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Counter-clockwise rectangle with vertices at most 0.1 apart, the first at the lower left corner.
Polygon rectangle(double x, double y, double width, double height) {
  Polygon polygon;
  const auto side = [&](Point a, Point b) {
    const int count = static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / 0.1 - 1e-9));
    for (int i = 0; i < count; ++i) polygon.push_back({a.x + (b.x - a.x) * i / count, a.y + (b.y - a.y) * i / count});
  };
  const Point p0{x, y}, p1{x + width, y}, p2{x + width, y + height}, p3{x, y + height};
  side(p0, p1), side(p1, p2), side(p2, p3), side(p3, p0);
  return polygon;
}

const Membrane membrane{.contact_distance = 0.1, .range = 0.3};  // probe radius 0.065

long count(const Exposure& exposure) { return std::count(exposure.exposed.begin(), exposure.exposed.end(), 1); }

int vertex_at(const TissueState& state, double x, double y) {
  for (int v = 0; v < state.tissue.vertex_count(); ++v)
    if (std::hypot(state.view().x[v] - x, state.view().y[v] - y) < 1e-9) return v;
  FAIL("no vertex there");
  return -1;
}

}  // namespace

TEST_CASE("every vertex of a lone cell is exposed", "[unit]") {
  const TissueState state = tissue_of({rectangle(0, 0, 1, 1)});
  for (const ExposureRule rule : {ExposureRule::probe_disc, ExposureRule::contact_free}) {
    const Exposure exposure = exposed_vertices(state.tissue, state.view(), membrane, rule);
    CHECK(count(exposure) == 40);
    CHECK(*std::min_element(exposure.margin.begin(), exposure.margin.end()) > 0.0);
    CHECK(exposure.blocker == std::vector<int>(40, -1));
  }
}

TEST_CASE("facing membranes are exposed when the probe fits between them", "[unit]") {
  for (const double gap : {0.1, 0.129, 0.131, 0.14}) {
    const TissueState state = tissue_of({rectangle(0, 0, 1, 1), rectangle(1 + gap, 0, 1, 1)});
    for (const ExposureRule rule : {ExposureRule::probe_disc, ExposureRule::contact_free}) {
      const Exposure exposure = exposed_vertices(state.tissue, state.view(), membrane, rule);
      const int facing = vertex_at(state, 1.0, 0.5);
      CAPTURE(gap);
      CHECK(static_cast<bool>(exposure.exposed[facing]) == (gap > 0.13));
      CHECK(exposure.margin[facing] == Approx(gap - 0.13).epsilon(1e-9));
      CHECK(exposure.exposed[vertex_at(state, 0.0, 0.5)]);
    }
  }
}

TEST_CASE("at the mouth of a crack only the probe sees the corner", "[unit]") {
  const TissueState state = tissue_of({rectangle(0, 0, 1, 1), rectangle(1.1, 0, 1, 1)});
  const int corner = vertex_at(state, 1.0, 1.0), inside = vertex_at(state, 1.0, 0.9),
            before = vertex_at(state, 0.9, 1.0);
  const Exposure probe = exposed_vertices(state.tissue, state.view(), membrane);
  const Exposure strict = exposed_vertices(state.tissue, state.view(), membrane, ExposureRule::contact_free);
  // The probe's centre sits on the diagonal, 0.065 from the corner and 0.0712 from the other cell's corner.
  CHECK(probe.exposed[corner]);
  CHECK(probe.margin[corner] == Approx(std::hypot(0.1 - 0.065 / std::sqrt(2.0), 0.065 / std::sqrt(2.0)) - 0.065));
  CHECK_FALSE(strict.exposed[corner]);
  CHECK_FALSE(probe.exposed[inside]);
  CHECK(probe.exposed[before]);
  CHECK(strict.exposed[before]);
}

TEST_CASE("a narrow slot in one cell is not reached, a wide one is", "[unit]") {
  for (const double width : {0.1, 0.2}) {
    Polygon cell = rectangle(0, 0, 1, 1);
    const auto top = std::find_if(cell.begin(), cell.end(), [](Point p) { return p.y == 1.0 && p.x < 0.55; });
    Polygon slot;
    for (int i = 0; i <= 6; ++i) slot.push_back({0.5 + 0.5 * width, 1.0 - 0.1 * i});
    for (int i = 6; i >= 0; --i) slot.push_back({0.5 - 0.5 * width, 1.0 - 0.1 * i});
    const auto end = std::find_if(top, cell.end(), [&](Point p) { return p.x < 0.5 - 0.5 * width - 1e-9; });
    const auto place = cell.erase(
        std::find_if(cell.begin(), end, [&](Point p) { return p.y == 1.0 && p.x < 0.5 + 0.5 * width + 1e-9; }), end);
    cell.insert(place, slot.begin(), slot.end());
    const TissueState state = tissue_of({cell});
    const Exposure exposure = exposed_vertices(state.tissue, state.view(), membrane);
    CAPTURE(width);
    CHECK(static_cast<bool>(exposure.exposed[vertex_at(state, 0.5 + 0.5 * width, 0.8)]) == (width > 0.13));
    CHECK(exposure.exposed[vertex_at(state, 0.0, 0.5)]);
  }
}

TEST_CASE("a vertex whose probe lies deep inside another cell is not exposed", "[unit]") {
  const TissueState state = tissue_of({rectangle(0, 0, 1, 1), rectangle(-2, -2, 5, 5)});
  const Exposure exposure = exposed_vertices(state.tissue, state.view(), membrane);
  CHECK(std::count(exposure.exposed.begin(), exposure.exposed.begin() + 40, 1) == 0);
  CHECK(std::count(exposure.exposed.begin() + 40, exposure.exposed.end(), 1) == 200);
  CHECK(exposure.margin[0] < 0.0);
  CHECK(exposure.blocker[0] == -1);
}

TEST_CASE("exposure does not depend on what the workspace has seen before", "[unit]") {
  ExposureMeasure measure(default_membrane());
  const TissueState a = wounded_honeycomb(0.02, 1), b = wounded_honeycomb(0.02, 2);
  const Exposure first = measure(a.tissue, a.view());
  measure(b.tissue, b.view());
  const Exposure again = measure(a.tissue, a.view());
  CHECK(again.exposed == first.exposed);
  CHECK(again.margin == first.margin);
  CHECK(count(first) > 100);
}

TEST_CASE("exposure refuses impossible input by name", "[unit]") {
  CHECK_THROWS_AS(ExposureMeasure(Membrane{}), InputError);
  TissueState state = tissue_of({rectangle(0, 0, 1, 1)});
  state.mutable_view().x[3] = state.view().x[4], state.mutable_view().y[3] = state.view().y[4];
  CHECK_THROWS_WITH(exposed_vertices(state.tissue, state.view(), membrane), Catch::Contains("cell 0, vertex 3"));
  state.mutable_view().x[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(exposed_vertices(state.tissue, state.view(), membrane), NumericalError);
}

TEST_CASE("the membrane of a contact law", "[unit]") {
  const TissueState state = tissue_of({rectangle(0, 0, 1, 1)});
  CHECK(make_membrane({}, state.tissue).contact_distance == Approx(0.1));
  CHECK(make_membrane({.distance = 0.2, .range = 0.5}, state.tissue).probe_radius() == Approx(0.15));
  CHECK_THROWS_AS(make_membrane({.distance = 0.0}, state.tissue), InputError);
  CHECK_THROWS_AS(make_membrane({.range = -1.0}, state.tissue), InputError);
}
