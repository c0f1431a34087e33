#include "suture/measure/free_boundary.hpp"

#include <fmt/format.h>

#include "measure/boundary_pieces.hpp"
#include "suture/errors.hpp"

namespace suture {
namespace {

double cross(Point o, Point a, Point b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

/// Where an exposed vertex stands on the boundary.
struct Place {
  int loop, order;
  double parameter;
  int vertex;
  friend auto operator<=>(const Place&, const Place&) = default;
};

}  // namespace

struct FreeBoundary::Impl {
  Membrane membrane;
  SegmentGrid grid;
  Exposure exposure;
  BoundaryPieces boundary;
  std::vector<BoundaryLoop> loops;
  std::vector<int> loop_of, order_of, size_order;
  std::vector<Place> places;

  void trace(const Tissue& tissue, const StateView& state);
  void add_to_loop(BoundaryLoop& loop, const Piece& piece, Point origin);
  void place_vertices(const Tissue& tissue);
  int nearest_piece(const Tissue& tissue, int vertex, double& parameter) const;
};

void FreeBoundary::Impl::add_to_loop(BoundaryLoop& loop, const Piece& piece, Point origin) {
  const double rho = membrane.probe_radius(), offset = membrane.half_width();
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

void FreeBoundary::Impl::trace(const Tissue& tissue, const StateView& state) {
  const std::span<const Piece> pieces = boundary.pieces();
  loops.clear();
  loop_of.assign(pieces.size(), -1);
  order_of.resize(pieces.size());
  for (int first = 0; first < static_cast<int>(pieces.size()); ++first) {
    if (loop_of[first] >= 0) continue;
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

int FreeBoundary::Impl::nearest_piece(const Tissue& tissue, int vertex, double& parameter) const {
  // The probe of a vertex sits in the middle of its arc.
  for (const Piece& piece : boundary.of_vertex(vertex))
    if (piece.arc && piece.low_cut < 0 && piece.high_cut < 0) {
      parameter = 0.5 * piece.high;
      return boundary.index(piece);
    }
  const Point p = probe_centre(tissue, grid, vertex, membrane.probe_radius());
  double least = membrane.probe_radius() * membrane.probe_radius();
  int best = -1;
  const auto look_at = [&](const Piece& piece) {
    const BoundaryPieces::Nearest found = boundary.nearest(piece, p);
    if (found.squared_distance > least) return;
    least = found.squared_distance;
    best = boundary.index(piece);
    parameter = found.parameter;
  };
  for (const Piece& piece : boundary.of_vertex(vertex)) look_at(piece);
  for (const Piece& piece : boundary.of_vertex(tissue.previous(vertex)))
    if (!piece.arc) look_at(piece);
  if (best < 0)
    for (const Piece& piece : boundary.pieces()) look_at(piece);
  return best;
}

/// A vertex belongs to the loop its probe's centre lies on. Between concave segments the probe is pushed off its
/// bisector, so the nearest point of the loop counts; a vertex without any within rho sits in a pocket of its own cell.
void FreeBoundary::Impl::place_vertices(const Tissue& tissue) {
  places.clear();
  for (int v = 0; v < tissue.vertex_count(); ++v) {
    if (!exposure.exposed[v]) continue;
    double parameter = 0.0;
    const int piece = nearest_piece(tissue, v, parameter);
    if (piece >= 0) places.push_back({loop_of[piece], order_of[piece], parameter, v});
  }
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
  Impl& m = *impl_;
  m.grid.build(tissue, state, grid_bucket_size(m.membrane));
  measure_exposure(tissue, state, m.grid, m.membrane, ExposureRule::probe_disc, m.exposure);
  m.boundary.evaluate(tissue, m.grid, m.exposure, m.membrane.probe_radius());
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
double FreeBoundary::largest_gap() const { return impl_->boundary.largest_gap(); }

}  // namespace suture
