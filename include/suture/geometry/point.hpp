// A point or vector of the plane.
#pragma once

#include <cmath>

namespace suture {

struct Point {
  double x = 0.0, y = 0.0;
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(double factor, Point a) { return {factor * a.x, factor * a.y}; }
};

inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
/// z component of a x b; positive when b is to the left of a.
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double squared_norm(Point a) { return dot(a, a); }
inline double norm(Point a) { return std::sqrt(dot(a, a)); }
/// a turned by +90 degrees.
inline Point left_normal(Point a) { return {-a.y, a.x}; }

}  // namespace suture
