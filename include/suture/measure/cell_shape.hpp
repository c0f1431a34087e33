// Size and shape of cells, and which of them line the wound (model.md section 7; Ton et al. 2023, Figs. 1, 3, 4).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "suture/measure/polygon.hpp"
#include "suture/model/state.hpp"

namespace suture {

struct CellShape {
  double area = 0.0;  ///< signed; negative for an inverted cell
  double perimeter = 0.0;
  Point centre;  ///< centre of area
  /// A = p^2/(4 pi a): 1 for a circle.
  double shape_parameter() const;
};

/// One per cell.
std::vector<CellShape> cell_shapes(const Tissue& tissue, const StateView& state);
/// a/a0 - 1 per cell.
std::vector<double> area_strains(const Tissue& tissue, const StateView& state);

/// Printed rule: cells with a vertex within sqrt(rest_area/pi) of the wound's outline, ascending.
/// A vertex inside the outline counts. Empty for an empty outline.
std::vector<int> adjacent_cells(const Tissue& tissue, const StateView& state, std::span<const Point> outline,
                                double rest_area = 1.0);
/// Rule of the published scripts: cells whose centre is within sqrt(4 rest_area/pi) of a purse-string vertex.
std::vector<int> adjacent_cells_published(const Tissue& tissue, const StateView& state, std::span<const Point> string,
                                          double rest_area = 1.0);

/// Mean shape parameter over `cells`; empty when there are none.
std::optional<double> mean_shape_parameter(std::span<const CellShape> shapes, std::span<const int> cells);
/// Shape of the healed tissue: the mean over the adjacent cells or, when the wound has left none, over the six largest
/// shape parameters, as the published scripts do. Throws InputError when there are no cells.
double healed_shape(std::span<const CellShape> shapes, std::span<const int> adjacent);

}  // namespace suture
