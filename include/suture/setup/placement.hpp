// Where the cells start: discs spread in a circle, then a regular polygon in each.
#pragma once

#include <span>
#include <vector>

#include "suture/model/tissue.hpp"
#include "suture/setup/random.hpp"

namespace suture {

/// Discs of given radii in a circle around the origin.
struct DiscPlacement {
  std::vector<double> x, y;
  double deepest_overlap = 0.0;  ///< largest (r_i + r_j - d_ij) of neighbours, or (r_i + r - R) at the wall; <= 0: none touch
};

/// Random centres, spread by minimising the soft overlaps sum (1 - d/(r_i + r_j))^2 (wall: (1 - (R - r)/r_i)^2).
DiscPlacement spread_discs(std::span<const double> radii, double wall_radius, RandomStream& random);

/// Renumbers the places of the cells of each kind (material and number of vertices) along a space-filling curve, so that neighbours
/// have close numbers: a rate of a large tissue then finds them in the cache. Places keep their kind.
void number_along_curve(const Tissue& tissue, DiscPlacement& centres);

/// Positions (all x, then all y) of one regular polygon per cell with its corners `corner_radius[cell]` from its
/// centre, turned at random and each corner moved radially by a normal random fraction `noise` of that radius.
std::vector<double> regular_polygons(const Tissue& tissue, const DiscPlacement& centres,
                                     std::span<const double> corner_radius, double noise, RandomStream& random);

}  // namespace suture
