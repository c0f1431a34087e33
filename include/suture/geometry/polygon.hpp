// Measures of a closed polygon given by its vertices in order (the last joins the first).
#pragma once

#include <span>

#include "suture/geometry/point.hpp"

namespace suture {

/// Shoelace area; positive when the vertices run counter-clockwise. x, y: one entry per vertex.
/// Coordinates are taken relative to the first vertex, so a cell far from the origin loses no digits.
double signed_area(std::span<const double> x, std::span<const double> y);

/// Length of the boundary.
double perimeter(std::span<const double> x, std::span<const double> y);

/// Centroid of the enclosed area. Throws NumericalError when the area is zero.
Point centroid(std::span<const double> x, std::span<const double> y);

/// Shape parameter A = p^2/(4 pi |a|): 1 for a circle, larger otherwise. Throws NumericalError when the area is zero.
double shape_parameter(std::span<const double> x, std::span<const double> y);

}  // namespace suture
