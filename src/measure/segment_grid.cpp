#include "measure/segment_grid.hpp"

#include <fmt/format.h>

#include <limits>
#include <numeric>

#include "suture/errors.hpp"

namespace suture {

void SegmentGrid::measure_segments(const Tissue& tissue, const StateView& state) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  segments_.resize(tissue.vertex_count());
  arc_.resize(tissue.vertex_count());
  boxes_.resize(tissue.cell_count());
  perimeter_.resize(tissue.cell_count());
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    BoundingBox box{infinity, -infinity, infinity, -infinity};
    double arc = 0.0;
    for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) {
      const int w = v + 1 == tissue.end_vertex(cell) ? tissue.first_vertex(cell) : v + 1;
      const double ex = state.x[w] - state.x[v], ey = state.y[w] - state.y[v];
      const double length = std::sqrt(ex * ex + ey * ey);
      if (!(length > 0.0) || !std::isfinite(length))
        throw NumericalError(fmt::format("{} is at ({}, {}) and its segment has length {}", tissue.vertex_name(v),
                                         state.x[v], state.y[v], length));
      const double inverse = 1.0 / length;
      segments_[v] = {state.x[v], state.y[v], ex * inverse, ey * inverse, length, cell};
      arc_[v] = arc;
      arc += length;
      box.x_low = std::min(box.x_low, state.x[v]), box.x_high = std::max(box.x_high, state.x[v]);
      box.y_low = std::min(box.y_low, state.y[v]), box.y_high = std::max(box.y_high, state.y[v]);
    }
    boxes_[cell] = box;
    perimeter_[cell] = arc;
  }
}

void SegmentGrid::sort_boxes() {
  by_left_.resize(boxes_.size());
  std::iota(by_left_.begin(), by_left_.end(), 0);
  std::sort(by_left_.begin(), by_left_.end(), [this](int a, int b) { return boxes_[a].x_low < boxes_[b].x_low; });
  widest_ = 0.0;
  for (const BoundingBox& box : boxes_) widest_ = std::max(widest_, box.x_high - box.x_low);
  widest_ *= 1.0 + 1e-9;  // beyond rounding
}

void SegmentGrid::choose_buckets(double bucket_size) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  BoundingBox all{infinity, -infinity, infinity, -infinity};
  for (const BoundingBox& box : boxes_) {
    all.x_low = std::min(all.x_low, box.x_low), all.x_high = std::max(all.x_high, box.x_high);
    all.y_low = std::min(all.y_low, box.y_low), all.y_high = std::max(all.y_high, box.y_high);
  }
  if (boxes_.empty()) all = {0.0, 0.0, 0.0, 0.0};
  const double width = all.x_high - all.x_low, height = all.y_high - all.y_low;
  // A cell that has escaped far away must not make the grid larger than the tissue is worth.
  const double most_buckets = 16.0 * static_cast<double>(segments_.size()) + 16.0;
  bucket_ = std::max(bucket_size, std::sqrt(width * height / most_buckets));
  bucket_ = std::max(bucket_, std::max(width, height) / most_buckets);
  inverse_bucket_ = 1.0 / bucket_;
  x_low_ = all.x_low, y_low_ = all.y_low;
  columns_ = static_cast<int>(width * inverse_bucket_) + 1;
  rows_ = static_cast<int>(height * inverse_bucket_) + 1;
}

void SegmentGrid::build_unsorted(const Tissue& tissue, const StateView& state) {
  measure_segments(tissue, state);
  sort_boxes();
}

void SegmentGrid::build(const Tissue& tissue, const StateView& state, double bucket_size, const std::optional<BoundingBox>& within) {
  build_unsorted(tissue, state);
  choose_buckets(bucket_size);
  start_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  entry_segment_.clear();
  entry_bucket_.clear();
  // A segment is filed under points at most a bucket apart, so each of its points is within half a bucket of one.
  for (int v = 0; v < static_cast<int>(segments_.size()); ++v) {
    const MembraneSegment& s = segments_[v];
    if (within && (std::max(s.ax, s.bx()) < within->x_low || std::min(s.ax, s.bx()) > within->x_high ||
                   std::max(s.ay, s.by()) < within->y_low || std::min(s.ay, s.by()) > within->y_high))
      continue;
    const int pieces = std::max(1, static_cast<int>(std::ceil(s.length * inverse_bucket_)));
    for (int i = 0; i < pieces; ++i) {
      const double t = s.length * (i + 0.5) / pieces;
      const int bucket = row(s.ay + t * s.uy) * columns_ + column(s.ax + t * s.ux);
      entry_segment_.push_back(v);
      entry_bucket_.push_back(bucket);
      ++start_[bucket];
    }
  }
  int sum = 0;
  for (int& count : start_) sum += count, count = sum;
  sorted_.resize(entry_segment_.size());
  for (int k = static_cast<int>(entry_segment_.size()) - 1; k >= 0; --k)
    sorted_[--start_[entry_bucket_[k]]] = entry_segment_[k];
}

}  // namespace suture
