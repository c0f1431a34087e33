#include "suture/measure/patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "suture/errors.hpp"
#include "suture/measure/cell_shape.hpp"
#include "suture/measure/neighbours.hpp"
#include "suture/measure/wound.hpp"

namespace suture {

Extents tissue_extents(const Tissue& tissue, const StateView& state) {
  if (tissue.cell_count() == 0) throw InputError("a tissue without cells has no extents");
  double area = 0.0;
  Extents extents{};
  for (const CellShape& shape : cell_shapes(tissue, state)) {
    area += shape.area;
    extents.centre.x += shape.area * shape.centre.x;
    extents.centre.y += shape.area * shape.centre.y;
  }
  extents.centre.x /= area, extents.centre.y /= area;
  Polygon points;
  for (int v = 0; v < tissue.vertex_count(); ++v) {
    points.push_back({state.x[v], state.y[v]});
    extents.radius = std::max(extents.radius, std::hypot(state.x[v] - extents.centre.x, state.y[v] - extents.centre.y));
  }
  extents.box = bounding_box(points);
  return extents;
}

double packing_fraction(const Tissue& tissue, const StateView& state, const Membrane& membrane, double wall_radius) {
  if (!(wall_radius > 0.0)) throw InputError(fmt::format("wall radius {} is not positive", wall_radius));
  const double sigma = membrane.half_width();
  double sum = 0.0;
  for (const CellShape& shape : cell_shapes(tissue, state))
    sum += shape.area + shape.perimeter * sigma + std::numbers::pi * sigma * sigma;
  return sum / (std::numbers::pi * wall_radius * wall_radius);
}

PatchReport inspect_patch(const Tissue& tissue, const StateView& state, const Membrane& membrane, bool wounded) {
  PatchReport report;
  std::vector<int> component;
  report.components = contact_graph(tissue, state, membrane).components(component);
  FreeBoundary boundary(membrane);
  boundary.evaluate(tissue, state);
  report.holes = hole_areas(boundary);
  if (wounded && !report.holes.empty()) {
    report.wound_area = report.holes.front();
    report.holes.erase(report.holes.begin());
  }
  return report;
}

}  // namespace suture
