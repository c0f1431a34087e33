#include "suture/physics/area_elasticity.hpp"

#include <vector>

#include "suture/geometry/polygon.hpp"

namespace suture {

namespace {

/// a_i/a0_i - 1.
double strain(const Tissue& tissue, int cell, const StateView& state) {
  const int first = tissue.first_vertex(cell), count = tissue.vertex_count(cell);
  return signed_area(state.x.subspan(first, count), state.y.subspan(first, count)) / tissue.material(cell).rest_area -
         1.0;
}

/// Gradient of the area of the vertex's cell.
Point area_gradient(const Tissue& tissue, int vertex, const StateView& state) {
  const int next = tissue.next(vertex), previous = tissue.previous(vertex);
  return {0.5 * (state.y[next] - state.y[previous]), 0.5 * (state.x[previous] - state.x[next])};
}

}  // namespace

double AreaElasticity::energy(double, const StateView& state) const {
  double sum = 0.0;
  for (int cell = 0; cell < tissue_.cell_count(); ++cell) {
    const double cell_strain = strain(tissue_, cell, state);
    sum += 0.5 * tissue_.material(cell).area_stiffness * cell_strain * cell_strain;
  }
  return sum;
}

void AreaElasticity::add_gradient(double, const StateView& state, MutableStateView gradient) const {
  for (int cell = 0; cell < tissue_.cell_count(); ++cell) {
    const CellMaterial& material = tissue_.material(cell);
    const double slope = material.area_stiffness / material.rest_area * strain(tissue_, cell, state);
    for (int v = tissue_.first_vertex(cell); v < tissue_.end_vertex(cell); ++v) {
      const Point g = area_gradient(tissue_, v, state);
      gradient.x[v] += slope * g.x;
      gradient.y[v] += slope * g.y;
    }
  }
}

void AreaElasticity::add_hessian(double, const StateView& state, HessianSink& sink) const {
  std::vector<double> gx, gy;
  for (int cell = 0; cell < tissue_.cell_count(); ++cell) {
    const CellMaterial& material = tissue_.material(cell);
    const double slope = material.area_stiffness / material.rest_area * strain(tissue_, cell, state);
    gx.clear(), gy.clear();
    for (int v = tissue_.first_vertex(cell); v < tissue_.end_vertex(cell); ++v) {
      const Point g = area_gradient(tissue_, v, state);
      gx.push_back(g.x), gy.push_back(g.y);
      sink.add_block(v, tissue_.next(v), {0.0, 0.5 * slope, -0.5 * slope, 0.0});
    }
    sink.add_rank_one(tissue_.first_vertex(cell), material.area_stiffness / (material.rest_area * material.rest_area),
                      gx, gy);
  }
}

}  // namespace suture
