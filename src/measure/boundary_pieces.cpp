#include "measure/boundary_pieces.hpp"

#include <limits>
#include <numbers>

namespace suture {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double cross(const MembraneSegment& a, const MembraneSegment& b) { return a.ux * b.uy - a.uy * b.ux; }
double dot(const MembraneSegment& a, const MembraneSegment& b) { return a.ux * b.ux + a.uy * b.uy; }
double squared(double x) { return x * x; }

}  // namespace

void BoundaryPieces::evaluate(const Tissue& tissue, const SegmentGrid& grid, const Exposure& exposure, std::span<const char> watched,
                              double rho) {
  tissue_ = &tissue, grid_ = &grid, exposure_ = &exposure, watched_ = watched, rho_ = rho;
  pieces_.clear();
  begin_.assign(1, 0);
  for (int v = 0; v < tissue.vertex_count(); ++v) {
    if (watches(v)) add_arc(v);
    if (watches_segment(v)) add_line(v);
    begin_.push_back(static_cast<int>(pieces_.size()));
  }
  squared_gap_ = 0.0;
  link_along_membrane();
  link_cuts();
  link_leftovers();
}

Point BoundaryPieces::point(const Piece& piece, double parameter, double offset) const {
  const SegmentGrid& grid = *grid_;
  if (piece.arc) {
    const MembraneSegment& before = grid[tissue_->previous(piece.feature)];
    const MembraneSegment& after = grid[piece.feature];
    const bool begins = parameter == 0.0;  // as most arcs do: cos 0 = 1 and sin 0 = 0 exactly
    const double c = begins ? offset : offset * std::cos(parameter), s = begins ? 0.0 : offset * std::sin(parameter);
    return {after.ax + c * before.uy + s * before.ux, after.ay - c * before.ux + s * before.uy};
  }
  const MembraneSegment& segment = grid[piece.feature];
  return {segment.ax + parameter * segment.ux + offset * segment.uy,
          segment.ay + parameter * segment.uy - offset * segment.ux};
}

double BoundaryPieces::middle_of_arc(int vertex) const {
  const MembraneSegment &in = (*grid_)[tissue_->previous(vertex)], &out = (*grid_)[vertex];
  return 0.5 * std::atan2(cross(in, out), dot(in, out));
}

void BoundaryPieces::add_pieces(int feature, bool arc) {
  for (const Interval& i : uncovered_.intervals()) {
    Piece piece{feature, arc, i.low, i.high, i.low_cut, i.high_cut, {}, {}};
    piece.start = point(piece, i.low, rho_);
    piece.end = point(piece, i.high, rho_);
    pieces_.push_back(piece);
  }
}

void BoundaryPieces::add_arc(int v) {
  const SegmentGrid& grid = *grid_;
  const int before = tissue_->previous(v);
  const MembraneSegment &in = grid[before], &out = grid[v];
  const double sine = cross(in, out);
  if (sine < 0.0 || (sine == 0.0 && dot(in, out) > 0.0)) return;
  const double x = out.ax, y = out.ay, cosine = dot(in, out);
  const Point first{x + rho_ * in.uy, y - rho_ * in.ux}, last{x + rho_ * out.uy, y - rho_ * out.ux};
  const double limit = rho_ * rho_;
  // One thickened segment covers one interval of the circle, so with both ends it covers the arc between them.
  const auto covers = [&](int j) {
    return grid[j].squared_distance(first.x, first.y) <= limit && grid[j].squared_distance(last.x, last.y) <= limit;
  };
  const int blocker = exposure_->blocker[v];
  if (blocker >= 0)
    for (const int hint : {blocker, tissue_->previous(blocker), tissue_->next(blocker)})
      if (hint != v && hint != before && covers(hint)) return;
  // All of the arc is within `radius` of its middle, so segments farther than rho + radius from that do not matter.
  const Point middle = probe_centre(*tissue_, grid, v, rho_);
  const double radius = std::sqrt(squared(first.x - middle.x) + squared(first.y - middle.y));
  const double squared_reach = squared(rho_ + radius);
  candidates_.clear();
  const bool covered = grid.visit_near({middle.x, middle.x, middle.y, middle.y}, rho_ + radius, [&](int j) {
    if (j == v || j == before || grid[j].squared_distance(middle.x, middle.y) >= squared_reach) return false;
    candidates_.push_back(j);
    return covers(j);
  });
  if (covered) return;
  uncovered_.reset(std::atan2(sine, cosine));
  for (const int j : candidates_) {
    const Covered c = covered_arc(grid[j], x, y, in.uy, -in.ux, rho_);
    for (const double turn : {-2.0 * std::numbers::pi, 0.0, 2.0 * std::numbers::pi})
      uncovered_.remove(c.low + turn, c.high + turn, j);
    if (uncovered_.empty()) return;
  }
  add_pieces(v, true);
}

void BoundaryPieces::remove_adjacent(int v) {
  const SegmentGrid& grid = *grid_;
  const int before = tissue_->previous(v), after = tissue_->next(v);
  const MembraneSegment& s = grid[v];
  const double x = s.ax + rho_ * s.uy, y = s.ay - rho_ * s.ux;
  // At a concave vertex the neighbour covers the line up to the shared vertex, whose own disc only touches it there.
  if (cross(grid[before], s) < 0.0) {
    const Covered c = covered_line(grid[before], x, y, s.ux, s.uy, rho_, false, true);
    if (c.low < c.high) uncovered_.remove(-infinity, c.high, before);
  }
  if (cross(s, grid[after]) < 0.0) {
    const Covered c = covered_line(grid[after], x, y, s.ux, s.uy, rho_, true, false);
    if (c.low < c.high) uncovered_.remove(c.low, infinity, after);
  }
}

bool BoundaryPieces::cover_line(int v, int j) {
  if (j == v || j == tissue_->previous(v) || j == tissue_->next(v)) return false;
  const MembraneSegment& s = (*grid_)[v];
  const double x = s.ax + rho_ * s.uy, y = s.ay - rho_ * s.ux, half = 0.5 * s.length;
  if ((*grid_)[j].squared_distance(x + half * s.ux, y + half * s.uy) >= squared(rho_ + half)) return false;
  const Covered c = covered_line((*grid_)[j], x, y, s.ux, s.uy, rho_);
  if (c.low < c.high) uncovered_.remove(c.low, c.high, j);
  return uncovered_.empty();
}

void BoundaryPieces::add_line(int v) {
  const MembraneSegment& s = (*grid_)[v];
  uncovered_.reset(s.length);
  for (const int blocker : {exposure_->blocker[v], exposure_->blocker[tissue_->next(v)]}) {
    if (blocker < 0) continue;
    for (const int hint : {blocker, tissue_->previous(blocker), tissue_->next(blocker)})
      if (cover_line(v, hint)) return;
  }
  remove_adjacent(v);
  if (uncovered_.empty()) return;
  const double x = s.ax + rho_ * s.uy, y = s.ay - rho_ * s.ux;
  const double x_end = x + s.length * s.ux, y_end = y + s.length * s.uy;
  const BoundingBox box{std::min(x, x_end), std::max(x, x_end), std::min(y, y_end), std::max(y, y_end)};
  if (!grid_->visit_near(box, rho_, [&](int j) { return cover_line(v, j); })) add_pieces(v, false);
}

void BoundaryPieces::join(int end, int start) {
  pieces_[end].next = start;
  pieces_[start].previous = end;
  const Point a = pieces_[end].end, b = pieces_[start].start;
  squared_gap_ = std::max(squared_gap_, squared(b.x - a.x) + squared(b.y - a.y));
}

void BoundaryPieces::try_start(int end, int candidate, double& least, int& best) const {
  if (pieces_[candidate].previous >= 0) return;
  const Point a = pieces_[end].end, b = pieces_[candidate].start;
  const double d2 = squared(b.x - a.x) + squared(b.y - a.y);
  if (d2 < least) least = d2, best = candidate;
}

void BoundaryPieces::link_along_membrane() {
  const auto natural_start = [&](int v) {
    for (const Piece& piece : of_vertex(v))
      if (piece.low_cut < 0) return index(piece);
    return -1;
  };
  for (int i = 0; i < static_cast<int>(pieces_.size()); ++i) {
    const Piece& piece = pieces_[i];
    if (piece.high_cut >= 0) continue;
    int start = -1;
    if (piece.arc) {
      for (const Piece& candidate : of_vertex(piece.feature))
        if (!candidate.arc && candidate.low_cut < 0) start = index(candidate);
    } else {
      start = natural_start(tissue_->next(piece.feature));
    }
    if (start < 0 || pieces_[start].previous >= 0) continue;
    double least = squared(1e-6 * rho_);
    int best = -1;
    try_start(i, start, least, best);
    if (best >= 0) join(i, best);
  }
}

void BoundaryPieces::link_cuts() {
  for (int i = 0; i < static_cast<int>(pieces_.size()); ++i) {
    const int cut = pieces_[i].high_cut;
    if (cut < 0) continue;
    double least = squared(1e-6 * rho_);
    int best = -1;
    for (const int v : {cut, tissue_->next(cut)})
      for (const Piece& candidate : of_vertex(v)) try_start(i, index(candidate), least, best);
    if (best >= 0) join(i, best);
  }
}

bool BoundaryPieces::ends_unwatched(const Piece& piece) const {
  if (piece.high_cut >= 0) return !watches_segment(piece.high_cut);
  return piece.arc ? !watches_segment(piece.feature) : !watches(tissue_->next(piece.feature));
}

bool BoundaryPieces::starts_unwatched(const Piece& piece) const {
  if (piece.low_cut >= 0) return !watches_segment(piece.low_cut);
  return piece.arc ? !watches_segment(tissue_->previous(piece.feature)) : !watches(piece.feature);
}

/// Where three thickened segments meet in a point, rounding may have removed the piece that was expected. Where all is watched there are
/// as many open ends as open starts, so the nearest pairs close every loop; otherwise what is far apart may have its partner elsewhere.
void BoundaryPieces::link_leftovers() {
  const double farthest = watched_.empty() ? infinity : squared(1e-3 * rho_);
  open_ends_.clear();
  open_starts_.clear();
  for (int i = 0; i < static_cast<int>(pieces_.size()); ++i) {
    if (pieces_[i].next < 0 && !ends_unwatched(pieces_[i])) open_ends_.push_back(i);
    if (pieces_[i].previous < 0 && !starts_unwatched(pieces_[i])) open_starts_.push_back(i);
  }
  while (!open_ends_.empty()) {
    double least = farthest;
    int end = -1, start = -1;
    for (const int e : open_ends_) {
      const double before = least;
      for (const int s : open_starts_) try_start(e, s, least, start);
      if (least < before) end = e;
    }
    if (end < 0) return;
    join(end, start);
    std::erase(open_ends_, end);
    std::erase(open_starts_, start);
  }
}

}  // namespace suture
