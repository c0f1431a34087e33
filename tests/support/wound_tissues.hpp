// Synthetic tissues with wounds of known shape, and an independent count of the wound's area on a grid of pixels.
#pragma once

#include <functional>
#include <vector>

#include "suture/measure/membrane.hpp"
#include "suture/measure/polygon.hpp"
#include "suture/model/state.hpp"

namespace suture::test {

/// s and l2 of the default contact law for 30 vertices and A = 1.2.
Membrane default_membrane();

/// One cell per polygon (counter-clockwise); rest lengths are the present lengths.
TissueState tissue_of(const std::vector<Polygon>& cells);

/// `cells` sectors around the origin between r = inner(angle) and r = outer(angle), their side walls `gap` apart;
/// `inner_points` vertices on each inner edge, as many on the outer, `side_points` between on each side.
struct SectorRing {
  int cells = 8;
  std::function<double(double)> inner, outer;
  double gap = 0.13;
  int inner_points = 12, side_points = 6;
};
std::vector<Polygon> sector_ring(const SectorRing& ring);

/// Hexagonal cells of 6 * points_per_side vertices on a triangular lattice around the origin, `rings` rings about the
/// central cell, walls `gap` apart; lattice sites for which `removed` is true stay empty.
struct Honeycomb {
  int rings = 4;
  double spacing = 1.15;
  double gap = 0.13;
  int points_per_side = 5;
  std::function<bool(Point)> removed = [](Point) { return false; };
};
std::vector<Polygon> honeycomb(const Honeycomb& honeycomb);

/// About 45 hexagonal cells of 30 vertices around a wound of 5 missing cells, every vertex moved at random by up to
/// `noise` in x and y.
TissueState wounded_honeycomb(double noise = 0.0, unsigned seed = 1);

/// Vertices that lie inside the outline of another cell: none, unless cells have been pushed through each other.
std::vector<int> vertices_inside_other_cells(const TissueState& state);

/// Moves every vertex at random by up to `amplitude` in x and y.
void shake(TissueState& state, double amplitude, unsigned seed);
/// Rotates about the origin, then translates.
void move(TissueState& state, double angle, double dx, double dy);
/// The same tissue with cells in another order and each cell's vertices starting elsewhere;
/// new_vertex[v] is the new number of vertex v.
TissueState renumbered(const TissueState& state, unsigned seed, std::vector<int>& new_vertex);

/// Oracle of the wound area. A pixel is open when its centre is farther than rho = s(1 + l2)/2 from every cell; open
/// pixels connected to `start` (4 neighbours) are flooded; counted are the pixels within rho - s/2 of a flooded one.
/// Nothing is shared with the library but the definition. Returns 0 when no open pixel is within two pixels of start.
double flood_fill_area(const TissueState& state, const Membrane& membrane, Point start, double pixel);

}  // namespace suture::test
