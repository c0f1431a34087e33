// The same configuration, seen differently: moved, turned, mirrored, renumbered.
#pragma once

#include <string>
#include <vector>

#include "suture/geometry/point.hpp"
#include "suture/model/state.hpp"
#include "suture/physics/term.hpp"

namespace suture::test {

/// A view of a configuration under which the energy of an internal term must not change.
struct Transformed {
  std::string name;
  TissueState state;
  std::vector<int> point_from;               ///< point i of `state` is point point_from[i] of the original
  Point image_of_x{1, 0}, image_of_y{0, 1};  ///< where unit vectors go: the gradient turns with them

  Point turn(Point v) const { return v.x * image_of_x + v.y * image_of_y; }
};

Transformed translated(const TissueState& state, Point shift);
Transformed rotated(const TissueState& state, double angle);
/// Mirrored at the y axis; the vertices of every cell are reversed, so that they run counter-clockwise again.
Transformed reflected(const TissueState& state);
/// Vertex numbers of every cell advanced cyclically by `shift`.
Transformed cycled(const TissueState& state, int shift);
/// Cells in reverse order.
Transformed reordered(const TissueState& state);
/// Cell i is old cell cells[i].
Transformed reordered(const TissueState& state, const std::vector<int>& cells);

/// One of each.
std::vector<Transformed> all_transformations(const TissueState& state);

/// All lengths multiplied by `factor` (rest lengths too) and rest areas by its square.
TissueState scaled(const TissueState& state, double factor);

/// dU/dr of every point, in order.
std::vector<Point> point_gradient(const EnergyTerm& term, const TissueState& state);

}  // namespace suture::test
