// A small wound for the purse-string tests: cells in a circle around a hole, their inner vertices in ring order.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "suture/model/state.hpp"
#include "suture/physics/purse_string_operations.hpp"

namespace suture::test {

inline constexpr double contact_distance = 0.13;

/// `cells` cells of `vertices` vertices each; every cell a small circle, centred on a large one. All coordinates and
/// rest lengths are different, so that a misplaced number is noticed.
inline TissueState cells_around_a_hole(int cells = 5, int vertices = 8, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> jitter(-0.01, 0.01);
  TissueState state;
  std::vector<double> lengths(static_cast<std::size_t>(cells) * vertices);
  for (double& l : lengths) l = contact_distance + jitter(engine);
  state.tissue = Tissue(std::vector<int>(cells, vertices), std::vector<CellMaterial>(cells), lengths);
  state.time = 2.5;
  state.values.resize(state.layout().size());
  const MutableStateView view = state.mutable_view();
  for (int v = 0; v < state.tissue.vertex_count(); ++v) {
    const double cell_angle = 2.0 * std::numbers::pi * (v / vertices) / cells;
    const double angle = 2.0 * std::numbers::pi * (v % vertices) / vertices;
    view.x[v] = std::cos(cell_angle) + 0.4 * std::cos(angle) + jitter(engine);
    view.y[v] = std::sin(cell_angle) + 0.4 * std::sin(angle) + jitter(engine);
    view.rest_length[v] = lengths[v];
  }
  return state;
}

/// Parameters of a string whose numbers all differ.
inline PurseStringParameters ring_parameters(SpringLaw law = SpringLaw::quadratic) {
  PurseStringParameters parameters;
  parameters.law = law;
  parameters.stiffness = 1.3;
  parameters.constriction_rate = 0.7;
  parameters.minimum_rest_length = law == SpringLaw::relative ? 0.05 : 0.0;
  return parameters;
}

/// A string through every third vertex of the tissue.
inline TissueState with_string(const PurseStringParameters& parameters, unsigned seed = 1) {
  TissueState state = cells_around_a_hole(5, 8, seed);
  std::vector<int> boundary;
  for (int v = 0; v < state.tissue.vertex_count(); v += 3) boundary.push_back(v);
  return create_purse_string(std::move(state), boundary, parameters, contact_distance);
}

/// Puts purse-string vertex j at distance `length` from its cell vertex, at an angle.
inline void stretch_tether(TissueState& state, int j, double length, double angle) {
  const MutableStateView view = state.mutable_view();
  const int point = state.layout().ring_point(j), v = state.purse_string.vertex[j];
  view.x[point] = view.x[v] + length * std::cos(angle);
  view.y[point] = view.y[v] + length * std::sin(angle);
}

}  // namespace suture::test
