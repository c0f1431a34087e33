// Outlines as lists of points: what the measures return. Cells themselves are measured by geometry/polygon.hpp.
#pragma once

#include <span>
#include <vector>

#include "suture/geometry/point.hpp"

namespace suture {

/// Closed, the last point is joined to the first.
using Polygon = std::vector<Point>;

/// Axis-parallel extents; empty when low > high.
struct BoundingBox {
  double x_low, x_high, y_low, y_high;
};

/// Signed area, positive when counter-clockwise (shoelace, taken about the first point to keep digits).
double signed_area(std::span<const Point> polygon);
double perimeter(std::span<const Point> polygon);
/// Centre of area. A polygon without area returns the mean of its points.
Point centroid(std::span<const Point> polygon);
BoundingBox bounding_box(std::span<const Point> polygon);
/// Even-odd rule; points on the edge may go either way.
bool contains(std::span<const Point> polygon, Point point);
/// Squared distance from a point to the closed outline (not zero inside).
double squared_distance_to_outline(std::span<const Point> polygon, Point point);
/// Area common to two simple polygons, by `lines` horizontal mid-point scan lines: relative error about 1/lines^1.5.
double overlap_area(std::span<const Point> a, std::span<const Point> b, int lines = 64);

}  // namespace suture
