#include "measure/coverage.hpp"

#include <limits>
#include <numbers>

namespace suture {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void extend(Covered& covered, double low, double high) {
  covered.low = std::min(covered.low, low);
  covered.high = std::max(covered.high, high);
}

/// Clips [low, high] to a <= offset + t slope <= b.
void clip(Covered& range, double offset, double slope, double a, double b) {
  constexpr double parallel = 1e-14;
  if (std::abs(slope) < parallel) {
    if (offset < a || offset > b) range = {infinity, -infinity};
    return;
  }
  const double t_a = (a - offset) / slope, t_b = (b - offset) / slope;
  range.low = std::max(range.low, std::min(t_a, t_b));
  range.high = std::min(range.high, std::max(t_a, t_b));
}

}  // namespace

void Uncovered::reset(double length) {
  intervals_.clear();
  if (length > 0.0) intervals_.push_back({0.0, length, -1, -1});
}

void Uncovered::remove(double low, double high, int segment) {
  for (std::size_t i = 0; i < intervals_.size();) {
    const Interval old = intervals_[i];
    if (high <= old.low || low >= old.high) {
      ++i;
      continue;
    }
    const bool left = low > old.low, right = high < old.high;
    if (left) intervals_[i] = {old.low, low, old.low_cut, segment};
    if (right) {
      const Interval rest{high, old.high, segment, old.high_cut};
      if (left) {
        intervals_.insert(intervals_.begin() + static_cast<std::ptrdiff_t>(i) + 1, rest);
        ++i;
      } else {
        intervals_[i] = rest;
      }
    }
    if (left || right) {
      ++i;
    } else {
      intervals_.erase(intervals_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

Covered covered_line(const MembraneSegment& segment, double x, double y, double ux, double uy, double rho,
                     bool skip_start, bool skip_end) {
  Covered covered{infinity, -infinity};
  const auto add_disc = [&](double wx, double wy) {
    const double along = wx * ux + wy * uy, across = wx * uy - wy * ux;
    const double squared_half = rho * rho - across * across;
    if (squared_half <= 0.0) return;
    const double half = std::sqrt(squared_half);
    extend(covered, along - half, along + half);
  };
  const double wx = segment.ax - x, wy = segment.ay - y;
  if (!skip_start) add_disc(wx, wy);
  if (!skip_end) add_disc(wx + segment.length * segment.ux, wy + segment.length * segment.uy);
  Covered strip{-infinity, infinity};
  clip(strip, -(wx * segment.ux + wy * segment.uy), ux * segment.ux + uy * segment.uy, 0.0, segment.length);
  clip(strip, -(wy * segment.ux - wx * segment.uy), uy * segment.ux - ux * segment.uy, -rho, rho);
  if (strip.low < strip.high) extend(covered, strip.low, strip.high);
  return covered;
}

Covered covered_arc(const MembraneSegment& segment, double x, double y, double nx, double ny, double rho) {
  const double ax = segment.ax - x, ay = segment.ay - y;
  const double foot = std::min(std::max(-(ax * segment.ux + ay * segment.uy), 0.0), segment.length);
  const double cx = ax + foot * segment.ux, cy = ay + foot * segment.uy;  // to the nearest point of the segment
  const double squared_distance = cx * cx + cy * cy;
  if (squared_distance >= 4.0 * rho * rho) return {infinity, -infinity};
  const double middle = std::atan2(nx * cy - ny * cx, nx * cx + ny * cy);
  Covered relative{0.0, 0.0};
  const auto angle_from_middle = [&](double qx, double qy) { return std::atan2(cx * qy - cy * qx, cx * qx + cy * qy); };
  const auto add_disc = [&](double qx, double qy) {
    const double squared = qx * qx + qy * qy;
    if (squared >= 4.0 * rho * rho) return;
    const double half = std::acos(0.5 * std::sqrt(squared) / rho), towards = angle_from_middle(qx, qy);
    extend(relative, towards - half, towards + half);
  };
  add_disc(ax, ay);
  add_disc(ax + segment.length * segment.ux, ay + segment.length * segment.uy);
  // Where the circle crosses the straight side of the thickened segment that faces it.
  const double across = ax * segment.uy - ay * segment.ux;  // signed distance of the line, along (uy, -ux)
  const double side = across >= 0.0 ? 1.0 : -1.0, height = std::abs(across);
  if (height < 2.0 * rho) {
    const double gx = side * segment.uy, gy = -side * segment.ux;
    const double cosine = height / rho - 1.0, sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    for (const double sign : {-1.0, 1.0}) {
      const double px = rho * (cosine * gx - sign * sine * gy), py = rho * (cosine * gy + sign * sine * gx);
      const double along = (px - ax) * segment.ux + (py - ay) * segment.uy;
      // p lies on the circle at height - rho cosine = rho from the line.
      if (along > 0.0 && along < segment.length) {
        const double angle = angle_from_middle(px, py);
        extend(relative, angle, angle);
      }
    }
  }
  return {middle + relative.low, middle + relative.high};
}

}  // namespace suture
