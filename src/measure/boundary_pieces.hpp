// The uncovered lines and arcs of the thickened cells, and how they join: the working half of FreeBoundary.
#pragma once

#include <span>
#include <vector>

#include "measure/coverage.hpp"
#include "measure/exposure_core.hpp"

namespace suture {

/// Part of the line along segment `feature`, parameter = length from its first vertex, or of the arc about vertex
/// `feature`, parameter = angle from the outward normal of the segment before it.
struct Piece {
  int feature;
  bool arc;
  double low, high;
  int low_cut, high_cut;  ///< the segments that cut it; -1 where it joins its neighbour along the membrane
  Point start, end;
  int next = -1, previous = -1;  ///< -1 for good where what it joins is not watched
};

class BoundaryPieces {
 public:
  /// Collects and links. The grid, exposure (probe_disc) and tissue must belong together. watched: one flag per vertex, empty for
  /// all; arcs about other vertices and lines along segments that have such an end are not collected, and what they would join
  /// stays open.
  void evaluate(const Tissue& tissue, const SegmentGrid& grid, const Exposure& exposure, std::span<const char> watched, double rho);

  std::span<const Piece> pieces() const { return pieces_; }
  double largest_gap() const { return std::sqrt(squared_gap_); }
  /// Point at `offset` outside the membrane, on the normal through the piece's point at this parameter.
  Point point(const Piece& piece, double parameter, double offset) const;
  /// The pieces of the arc about vertex v and of the line along segment v.
  std::span<const Piece> of_vertex(int v) const { return pieces().subspan(begin_[v], begin_[v + 1] - begin_[v]); }
  /// Parameter of the bisector of a convex vertex.
  double middle_of_arc(int vertex) const;
  int index(const Piece& piece) const { return static_cast<int>(&piece - pieces_.data()); }

 private:
  void add_arc(int vertex);
  void add_line(int vertex);
  bool cover_line(int vertex, int segment);
  void remove_adjacent(int vertex);
  void add_pieces(int feature, bool arc);
  void link_along_membrane();
  void link_cuts();
  void link_leftovers();
  bool watches(int vertex) const { return watched_.empty() || watched_[vertex] != 0; }
  bool watches_segment(int segment) const { return watches(segment) && watches(tissue_->next(segment)); }
  /// Whether what the piece joins may not have been collected.
  bool ends_unwatched(const Piece& piece) const;
  bool starts_unwatched(const Piece& piece) const;
  void try_start(int end, int candidate, double& least, int& best) const;
  void join(int end, int start);

  const Tissue* tissue_ = nullptr;
  const SegmentGrid* grid_ = nullptr;
  const Exposure* exposure_ = nullptr;
  std::span<const char> watched_;
  double rho_ = 0.0, squared_gap_ = 0.0;
  Uncovered uncovered_;
  std::vector<Piece> pieces_;
  std::vector<int> begin_, candidates_, open_ends_, open_starts_;
};

}  // namespace suture
