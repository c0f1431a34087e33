#include "suture/measure/free_boundary.hpp"

#include <fmt/format.h>

#include <compare>
#include <numbers>

#include "measure/boundary_pieces.hpp"
#include "suture/errors.hpp"

namespace suture {
namespace {

double cross(Point o, Point a, Point b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

constexpr int left_out = -2;  // instead of the number of a loop: a chain that is not closed

/// Where an exposed vertex stands on the boundary: on a piece, or `step` vertices past its end (before its start).
struct Place {
  int loop, order;
  double parameter;
  int step, vertex;
  friend auto operator<=>(const Place&, const Place&) = default;
};

}  // namespace

struct FreeBoundary::Impl {
  Membrane membrane;
  double rho = 0.0;  ///< probe radius in use
  SegmentGrid grid;
  std::vector<char> watched;  // empty: all
  Exposure exposure;
  BoundaryPieces boundary;
  std::vector<BoundaryLoop> loops;
  std::vector<int> loop_of, order_of, size_order;
  std::vector<Place> places;

  void link(const Tissue& tissue);
  std::optional<BoundingBox> reach_of(const std::optional<BoundingBox>& within) const;
  void watch(const Tissue& tissue, const StateView& state, const std::optional<BoundingBox>& within);
  void leave_out_chains();
  void trace(const Tissue& tissue, const StateView& state);
  void add_to_loop(BoundaryLoop& loop, const Piece& piece, Point origin);
  void place_vertices(const Tissue& tissue);
  const Piece* own_arc(int vertex) const;
  const Piece* piece_before(const Tissue& tissue, int vertex, int& step) const;
  const Piece* piece_after(const Tissue& tissue, int vertex, int& step) const;
  bool reaches(Point a, Point b) const;
  Place at(const Piece& piece, double parameter, int step, int vertex) const;
};

void FreeBoundary::Impl::add_to_loop(BoundaryLoop& loop, const Piece& piece, Point origin) {
  const double offset = membrane.half_width();
  constexpr double arc_step = 0.25;  // radians: the chord of an arc of radius s/2 stays within 0.004 s of it
  loop.outline.push_back(boundary.point(piece, piece.low, offset));
  if (piece.arc) {
    const double angle = piece.high - piece.low;
    const Point centre = boundary.point(piece, 0.0, 0.0);
    loop.length += rho * angle;
    loop.signed_area += 0.5 * (rho * rho * angle + (centre.x - origin.x) * (piece.end.y - piece.start.y) -
                               (centre.y - origin.y) * (piece.end.x - piece.start.x));
    const int steps = static_cast<int>(angle / arc_step) + 1;
    for (int i = 1; i < steps; ++i)
      loop.outline.push_back(boundary.point(piece, piece.low + angle * i / steps, offset));
  } else {
    loop.length += piece.high - piece.low;
    loop.signed_area += 0.5 * cross(origin, piece.start, piece.end);
  }
  if (piece.high_cut >= 0) loop.outline.push_back(boundary.point(piece, piece.high, offset));
  loop.signed_area += 0.5 * cross(origin, piece.end, boundary.pieces()[piece.next].start);
}

/// Membranes exactly parallel and exactly 2 rho apart, which only drawn tissues have, leave lines whose coverage
/// rounding decides; a probe larger by one part in 1e9 settles them.
void FreeBoundary::Impl::link(const Tissue& tissue) {
  constexpr double rounding = 1e-6, enlargement = 1e-9;
  constexpr int attempts = 3;
  rho = membrane.probe_radius();
  boundary.evaluate(tissue, grid, exposure, watched, rho);
  for (int i = 1; i < attempts && boundary.largest_gap() > rounding * rho; ++i) {
    rho = membrane.probe_radius() * (1.0 + i * enlargement);
    boundary.evaluate(tissue, grid, exposure, watched, rho);
  }
}

/// Where segments can cover something that is watched: discs touch vertices, arcs and lines are a probe's radius from the membrane.
std::optional<BoundingBox> FreeBoundary::Impl::reach_of(const std::optional<BoundingBox>& within) const {
  if (!within) return within;
  const double reach = 4.0 * membrane.probe_radius();  // an arc of up to half a circle, whose middle is one from its vertex
  return BoundingBox{within->x_low - reach, within->x_high + reach, within->y_low - reach, within->y_high + reach};
}

void FreeBoundary::Impl::watch(const Tissue& tissue, const StateView& state, const std::optional<BoundingBox>& within) {
  watched.clear();
  if (!within) return;
  for (int v = 0; v < tissue.vertex_count(); ++v)
    watched.push_back(state.x[v] >= within->x_low && state.x[v] <= within->x_high && state.y[v] >= within->y_low && state.y[v] <= within->y_high);
}

void FreeBoundary::Impl::leave_out_chains() {
  const std::span<const Piece> pieces = boundary.pieces();
  for (int first = 0; first < static_cast<int>(pieces.size()); ++first)
    if (pieces[first].previous < 0)
      for (int i = first; i >= 0; i = pieces[i].next) loop_of[i] = left_out;
}

void FreeBoundary::Impl::trace(const Tissue& tissue, const StateView& state) {
  const std::span<const Piece> pieces = boundary.pieces();
  loops.clear();
  loop_of.assign(pieces.size(), -1);
  order_of.resize(pieces.size());
  leave_out_chains();
  for (int first = 0; first < static_cast<int>(pieces.size()); ++first) {
    if (loop_of[first] != -1) continue;
    BoundaryLoop loop;
    loop.inside_probe = pieces[first].start;
    int order = 0;
    for (int i = first; loop_of[i] < 0; i = pieces[i].next) {
      loop_of[i] = static_cast<int>(loops.size());
      order_of[i] = order++;
      add_to_loop(loop, pieces[i], loop.inside_probe);
    }
    // Deep inside a cell that has been pushed over this one, where no membrane is near, there is no free space.
    const int cell = tissue.cell_of(pieces[first].feature);
    if (inside_other_cell(tissue, state, grid, cell, loop.inside_probe)) loop.signed_area = 0.0;
    loops.push_back(std::move(loop));
  }
}

/// The piece of the vertex's own arc that holds the middle of the arc, where its probe sits.
const Piece* FreeBoundary::Impl::own_arc(int vertex) const {
  for (const Piece& piece : boundary.of_vertex(vertex)) {
    if (!piece.arc) continue;
    if (piece.low_cut < 0 && piece.high_cut < 0) return &piece;
    if (piece.low <= boundary.middle_of_arc(vertex) && boundary.middle_of_arc(vertex) <= piece.high) return &piece;
  }
  return nullptr;
}

/// The last piece met going back along the membrane, no farther than half a probe's circumference.
const Piece* FreeBoundary::Impl::piece_before(const Tissue& tissue, int vertex, int& step) const {
  double length = 0.0;
  step = 0;
  for (int v = tissue.previous(vertex); length < std::numbers::pi * rho; v = tissue.previous(v)) {
    ++step;
    length += grid[v].length;
    if (!boundary.of_vertex(v).empty()) return &boundary.of_vertex(v).back();
    if (v == vertex) break;
  }
  return nullptr;
}

const Piece* FreeBoundary::Impl::piece_after(const Tissue& tissue, int vertex, int& step) const {
  double length = 0.0;
  step = 0;
  for (int v = vertex; length < std::numbers::pi * rho; v = tissue.next(v)) {
    --step;
    length += grid[v].length;
    if (!boundary.of_vertex(v).empty()) return &boundary.of_vertex(v).front();
    if (v == tissue.previous(vertex)) break;
  }
  return nullptr;
}

bool FreeBoundary::Impl::reaches(Point a, Point b) const {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) <= rho * rho;
}

Place FreeBoundary::Impl::at(const Piece& piece, double parameter, int step, int vertex) const {
  const int index = boundary.index(piece);
  return {loop_of[index], order_of[index], parameter, step, vertex};
}

/// A vertex belongs to the loop its probe's centre lies on. Between concave segments the probe is pushed off its
/// bisector: the vertex then stands between the pieces before and after it along the membrane, if they come within rho
/// of its probe. If none does, it sits in a pocket of its own cell, which no probe can enter.
void FreeBoundary::Impl::place_vertices(const Tissue& tissue) {
  places.clear();
  for (int v = 0; v < tissue.vertex_count(); ++v) {
    if (!exposure.exposed[v]) continue;
    if (const Piece* arc = own_arc(v)) {
      places.push_back(at(*arc, 0.5 * (arc->low + arc->high), 0, v));
      continue;
    }
    const Point p = probe_centre(tissue, grid, v, rho);
    int step = 0;
    if (const Piece* piece = piece_before(tissue, v, step); piece && reaches(piece->end, p))
      places.push_back(at(*piece, piece->high, step, v));
    else if (const Piece* next = piece_after(tissue, v, step); next && reaches(next->start, p))
      places.push_back(at(*next, next->low, step, v));
  }
  std::erase_if(places, [](const Place& place) { return place.loop == left_out; });
  std::sort(places.begin(), places.end());
  for (const Place& place : places) loops[place.loop].vertices.push_back(place.vertex);
}

FreeBoundary::FreeBoundary(const Membrane& membrane) : impl_(std::make_unique<Impl>()) {
  impl_->membrane = membrane;
  if (!(membrane.contact_distance > 0.0))
    throw InputError(fmt::format("contact distance {} is not positive", membrane.contact_distance));
}
FreeBoundary::~FreeBoundary() = default;
FreeBoundary::FreeBoundary(FreeBoundary&&) noexcept = default;
FreeBoundary& FreeBoundary::operator=(FreeBoundary&&) noexcept = default;

void FreeBoundary::evaluate(const Tissue& tissue, const StateView& state) {
  expose(tissue, state);
  trace(tissue, state);
}

void FreeBoundary::expose(const Tissue& tissue, const StateView& state, const std::optional<BoundingBox>& within) {
  impl_->grid.build(tissue, state, grid_bucket_size(impl_->membrane), impl_->reach_of(within));
  impl_->watch(tissue, state, within);
  measure_exposure(tissue, state, impl_->grid, impl_->membrane, ExposureRule::probe_disc, impl_->watched, impl_->exposure);
}

void FreeBoundary::trace(const Tissue& tissue, const StateView& state) {
  Impl& m = *impl_;
  m.link(tissue);
  m.trace(tissue, state);
  m.place_vertices(tissue);
  std::erase_if(m.loops, [](const BoundaryLoop& loop) { return loop.signed_area == 0.0; });
  std::stable_sort(m.loops.begin(), m.loops.end(), [](const BoundaryLoop& a, const BoundaryLoop& b) {
    return std::abs(a.signed_area) > std::abs(b.signed_area);
  });
}

const Membrane& FreeBoundary::membrane() const { return impl_->membrane; }
std::span<const BoundaryLoop> FreeBoundary::loops() const { return impl_->loops; }
const Exposure& FreeBoundary::exposure() const { return impl_->exposure; }
bool FreeBoundary::left_out_meets(std::span<const Point> outline) const {
  const std::span<const Piece> pieces = impl_->boundary.pieces();
  const BoundingBox box = bounding_box(outline);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (impl_->loop_of[k] != left_out) continue;
    const auto [start, end] = std::pair(pieces[k].start, pieces[k].end);
    const double reach = impl_->rho + std::hypot(end.x - start.x, end.y - start.y);  // an arc stays within its radius of its chord
    if (start.x < box.x_low - reach || start.x > box.x_high + reach || start.y < box.y_low - reach || start.y > box.y_high + reach) continue;
    if (contains(outline, start) || squared_distance_to_outline(outline, start) <= reach * reach) return true;
  }
  return false;
}

double FreeBoundary::largest_gap() const { return impl_->boundary.largest_gap(); }

}  // namespace suture
