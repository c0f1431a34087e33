// The tissue as a whole: where it is, how densely packed, and whether it is fit to be wounded (model.md section 6).
#pragma once

#include <optional>
#include <vector>

#include "suture/measure/membrane.hpp"
#include "suture/measure/polygon.hpp"
#include "suture/model/state.hpp"

namespace suture {

struct Extents {
  BoundingBox box;      ///< of the cell vertices
  Point centre;         ///< centre of area of all cells
  double radius = 0.0;  ///< largest distance of a vertex from the centre
};
/// Throws InputError for a tissue without cells.
Extents tissue_extents(const Tissue& tissue, const StateView& state);

/// Share of a circular wall's area taken by cells with their half membranes: sum(a + p sigma + pi sigma^2)/(pi R^2),
/// sigma = s/2 (model.md section 6).
double packing_fraction(const Tissue& tissue, const StateView& state, const Membrane& membrane, double wall_radius);

/// Is the tissue one patch without holes?
struct PatchReport {
  int components = 0;                ///< connected by contact
  std::vector<double> holes;         ///< areas as Wound::area, largest first; a wound that was asked for is left out
  std::optional<double> wound_area;  ///< the largest hole, when wounded

  double largest_hole() const { return holes.empty() ? 0.0 : holes.front(); }
  bool confluent(double maximum_hole) const { return components == 1 && largest_hole() <= maximum_hole; }
};

/// wounded: the largest hole is the wound and is not counted among the holes.
PatchReport inspect_patch(const Tissue& tissue, const StateView& state, const Membrane& membrane, bool wounded);

}  // namespace suture
