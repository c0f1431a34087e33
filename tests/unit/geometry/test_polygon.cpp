#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "suture/errors.hpp"
#include "suture/geometry/polygon.hpp"

using namespace suture;

namespace {

// An L: the unit square with a 2 x 1 bar below it; counter-clockwise, one concave corner.
const std::vector<double> l_x{0, 2, 2, 1, 1, 0}, l_y{0, 0, 1, 1, 2, 2};

}  // namespace

TEST_CASE("area, perimeter and centroid of a non-convex polygon", "[unit]") {
  CHECK(signed_area(l_x, l_y) == Approx(3.0));
  CHECK(perimeter(l_x, l_y) == Approx(8.0));
  const Point c = centroid(l_x, l_y);
  CHECK(c.x == Approx((2.0 * 1.0 + 1.0 * 0.5) / 3.0));
  CHECK(c.y == Approx((2.0 * 0.5 + 1.0 * 1.5) / 3.0));
}

TEST_CASE("a clockwise polygon has negative area and the same centroid and shape", "[unit]") {
  const std::vector<double> x(l_x.rbegin(), l_x.rend()), y(l_y.rbegin(), l_y.rend());
  CHECK(signed_area(x, y) == Approx(-3.0));
  CHECK(centroid(x, y).x == Approx(centroid(l_x, l_y).x));
  CHECK(shape_parameter(x, y) == Approx(shape_parameter(l_x, l_y)));
}

TEST_CASE("the shape parameter of a regular polygon is n tan(pi/n)/pi", "[unit]") {
  for (const int n : {3, 4, 30}) {
    std::vector<double> x, y;
    for (int k = 0; k < n; ++k)
      x.push_back(3 + std::cos(2 * std::numbers::pi * k / n)), y.push_back(std::sin(2 * std::numbers::pi * k / n));
    CHECK(shape_parameter(x, y) == Approx(n * std::tan(std::numbers::pi / n) / std::numbers::pi));
  }
}

TEST_CASE("a cell far from the origin keeps its digits", "[unit]") {
  std::vector<double> x = l_x, y = l_y;
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += 1e8, y[k] -= 1e8;
  CHECK(signed_area(x, y) == 3.0);
}

TEST_CASE("a polygon without area has neither centroid nor shape", "[unit]") {
  const std::vector<double> x{0, 1, 2}, y{0, 1, 2};
  CHECK_THROWS_AS(centroid(x, y), NumericalError);
  CHECK_THROWS_AS(shape_parameter(x, y), NumericalError);
}
