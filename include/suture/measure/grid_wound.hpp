// The wound as the published program found it: a flood fill over a square grid (Ton et al. 2023; the rules are those of
// tandrewton/dpm, epi2D::calculateWoundArea). For preset `published_code`; suture's own measure is WoundTracker.
//
// With r = s/2 the radius of a vertex, grid points are r/2 apart, at multiples of r/2. One is occupied when it lies
// inside a cell or within r of a vertex in both x and y (a square, so the result depends on direction). The wound is the
// 4-connected component of free points that holds the seed point.
#pragma once

#include <cmath>
#include <vector>

#include "suture/geometry/point.hpp"
#include "suture/measure/membrane.hpp"
#include "suture/model/state.hpp"

namespace suture {

class GridWound {
 public:
  explicit GridWound(const Membrane& membrane);

  /// Finds the wound around the seed point. A seed that the tissue has covered moves to a free grid point up to five
  /// steps away; failing that, and when the wound has lost more than half its area at once, the wound goes on as the
  /// largest component that overlaps the one before. Returns the area (units of a0); 0 when there is none.
  double update(const Tissue& tissue, const StateView& state);
  void set_seed(Point seed) { seed_ = seed; }
  double area() const { return area_; }

  /// Whether the wound comes within the search window of the vertex: 4 grid points down and left, 3 up and right.
  bool beside(const StateView& state, int vertex) const;

  /// What the next update depends on, for checkpoints (byte_archive.hpp).
  template <class Archive>
  void fields(Archive& archive) {
    archive(seed_.x, seed_.y, area_, columns_, rows_, column_low_, row_low_, label_, wound_);
  }

 private:
  void remember();
  void lay_grid(const Tissue& tissue, const StateView& state);
  void occupy(const Tissue& tissue, const StateView& state);
  void occupy_cell(const Tissue& tissue, const StateView& state, int cell);
  int flood(int start, int label);
  int at_seed() const;
  int largest_overlap();
  /// Column or row of the grid point at or below a coordinate.
  int cell_of(double coordinate) const { return static_cast<int>(std::floor(coordinate / spacing_)); }
  int index(int column, int row) const { return (row - row_low_) * columns_ + column - column_low_; }
  bool inside(int column, int row) const {
    return column >= column_low_ && column < column_low_ + columns_ && row >= row_low_ && row < row_low_ + rows_;
  }

  double radius_, spacing_;
  Point seed_;
  double area_ = 0.0;
  int columns_ = 0, rows_ = 0, column_low_ = 0, row_low_ = 0;
  std::vector<int> label_;          // per grid point: occupied, free, or the label of its component
  int wound_ = 0;                   // label of the wound
  std::vector<int> stack_, before_; // scratch: points to visit; column, row of the wound before
  std::vector<double> crossings_;   // scratch: where a row crosses a cell's membrane
};

}  // namespace suture
