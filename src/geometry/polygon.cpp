#include "suture/geometry/polygon.hpp"

#include <cmath>
#include <numbers>

#include "suture/errors.hpp"

namespace suture {

double signed_area(std::span<const double> x, std::span<const double> y) {
  double twice_area = 0.0;
  for (std::size_t k = 1; k + 1 < x.size(); ++k)
    twice_area += (x[k] - x[0]) * (y[k + 1] - y[0]) - (x[k + 1] - x[0]) * (y[k] - y[0]);
  return 0.5 * twice_area;
}

double perimeter(std::span<const double> x, std::span<const double> y) {
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const std::size_t next = k + 1 == x.size() ? 0 : k + 1;
    sum += norm({x[next] - x[k], y[next] - y[k]});
  }
  return sum;
}

Point centroid(std::span<const double> x, std::span<const double> y) {
  double twice_area = 0.0;
  Point moment;
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    const Point a{x[k] - x[0], y[k] - y[0]}, b{x[k + 1] - x[0], y[k + 1] - y[0]};
    const double twice_triangle = cross(a, b);
    twice_area += twice_triangle;
    moment = moment + twice_triangle * (a + b);
  }
  if (twice_area == 0.0) throw NumericalError("a polygon of zero area has no centroid");
  return Point{x[0], y[0]} + (1.0 / (3.0 * twice_area)) * moment;
}

double shape_parameter(std::span<const double> x, std::span<const double> y) {
  const double area = std::abs(signed_area(x, y));
  if (area == 0.0) throw NumericalError("a polygon of zero area has no shape parameter");
  const double length = perimeter(x, y);
  return length * length / (4.0 * std::numbers::pi * area);
}

}  // namespace suture
