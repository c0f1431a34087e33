// Membrane segments sorted into square buckets, so that those near a point are found without looking at the others.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "suture/measure/polygon.hpp"
#include "suture/model/state.hpp"

namespace suture {

/// Segment from (ax, ay) along the unit vector (ux, uy); counter-clockwise cells have their outside on the right.
struct MembraneSegment {
  double ax, ay, ux, uy, length;
  int cell;

  double bx() const { return ax + length * ux; }
  double by() const { return ay + length * uy; }
  double squared_distance(double x, double y) const {
    const double wx = x - ax, wy = y - ay;
    const double t = std::min(std::max(wx * ux + wy * uy, 0.0), length);
    const double dx = wx - t * ux, dy = wy - t * uy;
    return dx * dx + dy * dy;
  }
};

class SegmentGrid {
 public:
  /// Keeps its memory between calls. within: segments that have no point in this box need not be visited. Throws NumericalError for a
  /// coordinate that is not finite or a segment without length.
  void build(const Tissue& tissue, const StateView& state, double bucket_size, const std::optional<BoundingBox>& within = {});
  /// Segments and boxes without buckets: everything but visit_near.
  void build_unsorted(const Tissue& tissue, const StateView& state);

  const MembraneSegment& operator[](int segment) const { return segments_[segment]; }
  const BoundingBox& box(int cell) const { return boxes_[cell]; }
  /// Length of membrane from the cell's first vertex to this one, and all the way round.
  double arc_position(int vertex) const { return arc_[vertex]; }
  double cell_perimeter(int cell) const { return perimeter_[cell]; }

  /// Calls visit(cell) for every cell whose box holds the point; stops and returns true as soon as visit does.
  template <typename Visit>
  bool visit_boxes_at(double x, double y, Visit&& visit) const {
    const auto left = [this](int cell, double value) { return boxes_[cell].x_low < value; };
    for (auto c = std::lower_bound(by_left_.begin(), by_left_.end(), x - widest_, left); c != by_left_.end(); ++c) {
      const BoundingBox& box = boxes_[*c];
      if (box.x_low > x) break;
      if (x <= box.x_high && y >= box.y_low && y <= box.y_high && visit(*c)) return true;
    }
    return false;
  }

  /// Calls visit(cell, other) once for every two cells whose boxes come within `reach` of each other in both directions.
  template <typename Visit>
  void visit_box_pairs(double reach, Visit&& visit) const {
    for (std::size_t i = 0; i < by_left_.size(); ++i) {
      const BoundingBox& a = boxes_[by_left_[i]];
      for (std::size_t j = i + 1; j < by_left_.size() && boxes_[by_left_[j]].x_low <= a.x_high + reach; ++j) {
        const BoundingBox& b = boxes_[by_left_[j]];
        if (b.y_low <= a.y_high + reach && a.y_low <= b.y_high + reach) visit(by_left_[i], by_left_[j]);
      }
    }
  }

  /// Calls visit(segment) for every segment that may come within `reach` of the box, some of them twice; stops and
  /// returns true as soon as visit does.
  template <typename Visit>
  bool visit_near(const BoundingBox& box, double reach, Visit&& visit) const {
    const double r = reach + 0.5 * bucket_;
    const int i_low = column(box.x_low - r), i_high = column(box.x_high + r);
    const int j_low = row(box.y_low - r), j_high = row(box.y_high + r);
    for (int j = j_low; j <= j_high; ++j) {
      const int end = start_[j * columns_ + i_high + 1];
      for (int k = start_[j * columns_ + i_low]; k < end; ++k)
        if (visit(sorted_[k])) return true;
    }
    return false;
  }

 private:
  int column(double x) const { return std::clamp(static_cast<int>((x - x_low_) * inverse_bucket_), 0, columns_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - y_low_) * inverse_bucket_), 0, rows_ - 1); }
  void measure_segments(const Tissue& tissue, const StateView& state);
  void sort_boxes();
  void choose_buckets(double bucket_size);

  std::vector<MembraneSegment> segments_;
  std::vector<BoundingBox> boxes_;
  std::vector<int> by_left_;  // cells by the left side of their boxes, of which none is wider than widest_
  double widest_ = 0.0;
  std::vector<double> arc_, perimeter_;
  std::vector<int> start_, sorted_, entry_segment_, entry_bucket_;
  double x_low_ = 0.0, y_low_ = 0.0, bucket_ = 1.0, inverse_bucket_ = 1.0;
  int columns_ = 1, rows_ = 1;
};

}  // namespace suture
