// Which part of a line or an arc lies within rho of a segment: the geometry under FreeBoundary.
#pragma once

#include <vector>

#include "measure/segment_grid.hpp"

namespace suture {

/// Where an interval begins and ends, and which segment cut it there (-1: its natural end).
struct Interval {
  double low, high;
  int low_cut, high_cut;
};

/// The parts of one line or arc not yet covered.
class Uncovered {
 public:
  void reset(double length);
  /// Removes [low, high], covered by `segment`.
  void remove(double low, double high, int segment);
  bool empty() const { return intervals_.empty(); }
  const std::vector<Interval>& intervals() const { return intervals_; }

 private:
  std::vector<Interval> intervals_;
};

/// Covered interval of a parameter; empty when low > high.
struct Covered {
  double low, high;
};

/// Line X(t) = (x, y) + t (ux, uy): where it is within rho of the segment. skip_start, skip_end: leave out the disc
/// about that end of the segment (it only touches the line when the end is shared).
Covered covered_line(const MembraneSegment& segment, double x, double y, double ux, double uy, double rho,
                     bool skip_start = false, bool skip_end = false);

/// Circle of radius rho about (x, y), angle measured counter-clockwise from the unit vector (nx, ny): the covered
/// interval of angles, its middle in (-pi, pi].
Covered covered_arc(const MembraneSegment& segment, double x, double y, double nx, double ny, double rho);

}  // namespace suture
