#include "suture/measure/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {
namespace {

/// Horizontal lines at equal distances across [low, low + count step].
struct Lines {
  double low, step;
  int count;
  double y(int i) const { return low + (i + 0.5) * step; }
};

/// x of the crossings of a polygon with each line, ascending: those of line i are x[start[i]] .. x[start[i + 1] - 1].
struct Crossings {
  std::vector<double> x;
  std::vector<int> start;
  std::span<const double> of(int i) const { return std::span(x).subspan(start[i], start[i + 1] - start[i]); }
};

/// visit(line, a, b) for every line that crosses the edge from a to b. A line more is tried at either end than rounding needs.
template <class Visit>
void visit_crossings(std::span<const Point> polygon, const Lines& lines, const Visit& visit) {
  const auto index = [&](double y) { return std::clamp((y - lines.low) / lines.step, -1.0, lines.count + 1.0); };
  Point a = polygon.back();
  for (const Point b : polygon) {
    const int first = std::max(0, static_cast<int>(index(std::min(a.y, b.y))) - 1);
    const int last = std::min(lines.count - 1, static_cast<int>(index(std::max(a.y, b.y))) + 1);
    for (int i = first; i <= last; ++i)
      if ((a.y > lines.y(i)) != (b.y > lines.y(i))) visit(i, a, b);
    a = b;
  }
}

Crossings crossings(std::span<const Point> polygon, const Lines& lines) {
  Crossings result;
  result.start.assign(static_cast<std::size_t>(lines.count) + 1, 0);
  visit_crossings(polygon, lines, [&](int i, Point, Point) { ++result.start[i]; });
  int sum = 0;
  for (int& end : result.start) sum += end, end = sum;
  result.x.resize(static_cast<std::size_t>(sum));
  visit_crossings(polygon, lines, [&](int i, Point a, Point b) {  // leaves every start where it should be
    result.x[--result.start[i]] = a.x + (lines.y(i) - a.y) / (b.y - a.y) * (b.x - a.x);
  });
  for (int i = 0; i < lines.count; ++i) std::sort(result.x.begin() + result.start[i], result.x.begin() + result.start[i + 1]);
  return result;
}

/// Length common to two unions of intervals given by their sorted ends.
double common_length(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  std::size_t i = 0, j = 0;
  while (i + 1 < a.size() && j + 1 < b.size()) {
    sum += std::max(0.0, std::min(a[i + 1], b[j + 1]) - std::max(a[i], b[j]));
    (a[i + 1] < b[j + 1] ? i : j) += 2;
  }
  return sum;
}

}  // namespace

double signed_area(std::span<const Point> polygon) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point o = polygon[0], a = polygon[i], b = polygon[i + 1];
    twice += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  }
  return 0.5 * twice;
}

double perimeter(std::span<const Point> polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    sum += std::hypot(b.x - a.x, b.y - a.y);
  }
  return sum;
}

Point centroid(std::span<const Point> polygon) {
  if (polygon.empty()) return {};
  const Point o = polygon[0];
  double twice = 0.0, mx = 0.0, my = 0.0, sx = 0.0, sy = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double cross = (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    twice += cross;
    mx += cross * (a.x + b.x - 2.0 * o.x);
    my += cross * (a.y + b.y - 2.0 * o.y);
    sx += a.x, sy += a.y;
  }
  const double count = static_cast<double>(polygon.size());
  if (twice == 0.0) return {sx / count, sy / count};
  return {o.x + mx / (3.0 * twice), o.y + my / (3.0 * twice)};
}

BoundingBox bounding_box(std::span<const Point> polygon) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  BoundingBox box{infinity, -infinity, infinity, -infinity};
  for (const Point p : polygon) {
    box.x_low = std::min(box.x_low, p.x), box.x_high = std::max(box.x_high, p.x);
    box.y_low = std::min(box.y_low, p.y), box.y_high = std::max(box.y_high, p.y);
  }
  return box;
}

bool contains(std::span<const Point> polygon, Point point) {
  bool inside = false;
  if (polygon.empty()) return inside;
  Point a = polygon.back();
  for (const Point b : polygon) {
    if ((a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x))
      inside = !inside;
    a = b;
  }
  return inside;
}

double squared_distance_to_outline(std::span<const Point> polygon, Point point) {
  double least = std::numeric_limits<double>::infinity();
  if (polygon.empty()) return least;
  Point a = polygon.back();
  for (const Point b : polygon) {
    const double ex = b.x - a.x, ey = b.y - a.y, wx = point.x - a.x, wy = point.y - a.y;
    const double squared_length = ex * ex + ey * ey;
    const double t = squared_length > 0.0 ? std::clamp((wx * ex + wy * ey) / squared_length, 0.0, 1.0) : 0.0;
    const double dx = wx - t * ex, dy = wy - t * ey;
    least = std::min(least, dx * dx + dy * dy);
    a = b;
  }
  return least;
}

double overlap_area(std::span<const Point> a, std::span<const Point> b, int lines) {
  if (a.empty() || b.empty()) return 0.0;
  const BoundingBox box_a = bounding_box(a), box_b = bounding_box(b);
  const double low = std::max(box_a.y_low, box_b.y_low), high = std::min(box_a.y_high, box_b.y_high);
  if (!(high > low)) return 0.0;
  const double step = (high - low) / lines;
  const Lines across{low, step, lines};
  const Crossings in_a = crossings(a, across), in_b = crossings(b, across);
  double sum = 0.0;
  for (int i = 0; i < lines; ++i) sum += common_length(in_a.of(i), in_b.of(i));
  return sum * step;
}

}  // namespace suture
