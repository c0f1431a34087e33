#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "suture/measure/polygon.hpp"

using namespace suture;

namespace {

Polygon rectangle(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

}  // namespace

TEST_CASE("area, perimeter and centre of a rectangle far from the origin", "[unit]") {
  const Polygon polygon = rectangle(1e3, -2e3, 2.0, 3.0);
  CHECK(signed_area(polygon) == Approx(6.0).epsilon(1e-12));
  CHECK(perimeter(polygon) == Approx(10.0).epsilon(1e-12));
  CHECK(centroid(polygon).x == Approx(1001.0).epsilon(1e-12));
  CHECK(centroid(polygon).y == Approx(-1998.5).epsilon(1e-12));
  const Polygon clockwise(polygon.rbegin(), polygon.rend());
  CHECK(signed_area(clockwise) == Approx(-6.0).epsilon(1e-12));
  CHECK(centroid(clockwise).y == Approx(-1998.5).epsilon(1e-12));
}

TEST_CASE("a polygon contains its inside, whichever way it runs", "[unit]") {
  const Polygon notch{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  CHECK(contains(notch, {0.5, 0.5}));
  CHECK_FALSE(contains(notch, {2.0, 2.0}));
  CHECK_FALSE(contains(notch, {5.0, 1.0}));
  CHECK_FALSE(contains({}, {0.0, 0.0}));
  CHECK(contains(Polygon(notch.rbegin(), notch.rend()), {0.5, 0.5}));
}

TEST_CASE("the distance to an outline is that to its nearest edge or corner", "[unit]") {
  const Polygon square = rectangle(0, 0, 1, 1);
  CHECK(squared_distance_to_outline(square, {0.5, 0.4}) == Approx(0.16));
  CHECK(squared_distance_to_outline(square, {2.0, 2.0}) == Approx(2.0));
  CHECK(std::isinf(squared_distance_to_outline({}, {0.0, 0.0})));
}

TEST_CASE("the overlap of two polygons", "[unit]") {
  const Polygon a = rectangle(0, 0, 2, 2), b = rectangle(1, 1, 5, 5);
  CHECK(overlap_area(a, b) == Approx(1.0).epsilon(1e-12));
  CHECK(overlap_area(b, a) == Approx(1.0).epsilon(1e-12));
  CHECK(overlap_area(a, rectangle(3, 0, 1, 1)) == 0.0);
  CHECK(overlap_area(a, {}) == 0.0);
  Polygon disc;
  for (int i = 0; i < 400; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 400;
    disc.push_back({1.0 + 0.5 * std::cos(angle), 2.0 + 0.5 * std::sin(angle)});
  }
  CHECK(overlap_area(a, disc) == Approx(0.5 * signed_area(disc)).epsilon(5e-3));
  CHECK(overlap_area(a, disc, 1000) == Approx(0.5 * signed_area(disc)).epsilon(1e-4));
}
