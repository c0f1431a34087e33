#include "suture/measure/cell_shape.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "suture/errors.hpp"
#include "suture/geometry/polygon.hpp"

namespace suture {
namespace {

void cell_polygon(const Tissue& tissue, const StateView& state, int cell, Polygon& out) {
  out.clear();
  for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) out.push_back({state.x[v], state.y[v]});
}

bool touches(std::span<const Point> cell, std::span<const Point> outline, const BoundingBox& outline_box,
             double reach) {
  return std::any_of(cell.begin(), cell.end(), [&](Point p) {
    if (p.x < outline_box.x_low - reach || p.x > outline_box.x_high + reach || p.y < outline_box.y_low - reach ||
        p.y > outline_box.y_high + reach)
      return false;
    return squared_distance_to_outline(outline, p) <= reach * reach || contains(outline, p);
  });
}

}  // namespace

double CellShape::shape_parameter() const { return perimeter * perimeter / (4.0 * std::numbers::pi * area); }

std::vector<CellShape> cell_shapes(const Tissue& tissue, const StateView& state) {
  std::vector<CellShape> shapes;
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    const auto x = state.x.subspan(tissue.first_vertex(cell), tissue.vertex_count(cell));
    const auto y = state.y.subspan(tissue.first_vertex(cell), tissue.vertex_count(cell));
    shapes.push_back({signed_area(x, y), perimeter(x, y), centroid(x, y)});
  }
  return shapes;
}

std::vector<double> area_strains(const Tissue& tissue, const StateView& state) {
  std::vector<double> strains;
  for (const CellShape& shape : cell_shapes(tissue, state))
    strains.push_back(shape.area / tissue.material(static_cast<int>(strains.size())).rest_area - 1.0);
  return strains;
}

std::vector<int> adjacent_cells(const Tissue& tissue, const StateView& state, std::span<const Point> outline,
                                double rest_area) {
  std::vector<int> cells;
  if (outline.empty()) return cells;
  const double reach = std::sqrt(rest_area / std::numbers::pi);
  const BoundingBox box = bounding_box(outline);
  Polygon polygon;
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    cell_polygon(tissue, state, cell, polygon);
    if (touches(polygon, outline, box, reach)) cells.push_back(cell);
  }
  return cells;
}

std::vector<int> adjacent_cells_published(const Tissue& tissue, const StateView& state, std::span<const Point> string,
                                          double rest_area) {
  const double reach = std::sqrt(4.0 * rest_area / std::numbers::pi);
  std::vector<int> cells;
  const std::vector<CellShape> shapes = cell_shapes(tissue, state);
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    const Point centre = shapes[cell].centre;
    if (std::any_of(string.begin(), string.end(),
                    [&](Point p) { return std::hypot(p.x - centre.x, p.y - centre.y) <= reach; }))
      cells.push_back(cell);
  }
  return cells;
}

std::optional<double> mean_shape_parameter(std::span<const CellShape> shapes, std::span<const int> cells) {
  if (cells.empty()) return std::nullopt;
  double sum = 0.0;
  for (const int cell : cells) sum += shapes[cell].shape_parameter();
  return sum / static_cast<double>(cells.size());
}

double healed_shape(std::span<const CellShape> shapes, std::span<const int> adjacent) {
  if (const auto mean = mean_shape_parameter(shapes, adjacent)) return *mean;
  if (shapes.empty()) throw InputError("the healed shape needs at least one cell");
  constexpr std::size_t published_count = 6;
  std::vector<double> values;
  for (const CellShape& shape : shapes) values.push_back(shape.shape_parameter());
  std::sort(values.begin(), values.end(), std::greater<>());
  values.resize(std::min(values.size(), published_count));
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace suture
