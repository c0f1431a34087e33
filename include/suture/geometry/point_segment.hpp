// The point of a segment closest to a given point, as a visible case distinction on the closest feature.
#pragma once

#include "suture/geometry/point.hpp"

namespace suture {

/// Where the closest point of segment AB lies.
enum class ClosestFeature { start, interior, end };

struct Projection {
  ClosestFeature feature = ClosestFeature::start;
  double t = 0.0;  ///< closest point A + t (B - A), clamped to [0, 1]
};

/// Clamped projection of p on the segment from a to b. The two must differ (a zero-length segment answers `start`).
/// The distance to the closest point is C1 in p, a and b where it is not zero; its second derivative jumps where the
/// feature changes.
inline Projection project(Point p, Point a, Point b) {
  const Point edge = b - a;
  const double along = dot(p - a, edge), squared_length = squared_norm(edge);
  if (along <= 0.0) return {ClosestFeature::start, 0.0};
  if (along >= squared_length) return {ClosestFeature::end, 1.0};
  return {ClosestFeature::interior, along / squared_length};
}

/// Distance from p to the segment from a to b, which must differ.
inline double point_segment_distance(Point p, Point a, Point b) {
  const Projection projection = project(p, a, b);
  if (projection.feature == ClosestFeature::interior) return std::abs(cross(b - a, p - a)) / norm(b - a);
  return norm(p - (projection.feature == ClosestFeature::start ? a : b));
}

}  // namespace suture
