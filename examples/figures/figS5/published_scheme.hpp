// Fig. S5 as its authors computed it, step by step: their start, their equations of motion and their order of operations,
// found by comparison with their table, all 92 areas and perimeters of which come out to its last digit. For validation only.
#pragma once

#include <cmath>
#include <cstdlib>
#include <vector>

#include "suture/errors.hpp"
#include "suture/measure/cell_shape.hpp"
#include "suture/model/parameters.hpp"
#include "suture/ode/tissue_ode.hpp"
#include "suture/simulate/cell_experiment.hpp"

namespace suture::figures {

/// Their round cell: vertices on a circle from angle 0 on, each moved by up to 0.01 l0 in x and in y (numbers of drand48 for
/// seed 1, behind the two that placed the cell), then the first three by 0.005 in x. The area is 1.00149, as in their table.
inline TissueState published_start(const Config& config) {
  TissueState cell = make_round_cell(config);
  const int n = cell.tissue.vertex_count();
  const double l0 = cell.tissue.mean_initial_rest_length(), step = 2.0 * std::acos(-1.0) / n, radius = std::sqrt(2.0 / (n * std::sin(step)));
  unsigned short random[3] = {0x330e, 1, 0};  // what srand48(1) sets
  erand48(random);
  erand48(random);
  for (int v = 0; v < n; ++v) {
    cell.values[v] = radius * std::cos(step * v) + 0.01 * l0 * erand48(random) + (v < 3 ? 0.005 : 0.0);
    cell.values[n + v] = radius * std::sin(step * v) + 0.01 * l0 * erand48(random);
  }
  return cell;
}

inline TissueOdeOptions dipole_options(const Config& config, const TissueState& cell) {
  TissueOdeOptions options{.membrane_law = config.membrane.law, .contact = config.contact};
  options.contact.distance = cell.tissue.mean_initial_rest_length();
  return options;
}

/// The cell after config.dipole.duration. Velocity Verlet with unit mass and unit damping, step 0.01 l0/sqrt(k_a), for vertices and
/// REST LENGTHS: l0'' + l0' = (l - l0)/tau. Forces are those of the new positions and the old rest lengths, which move afterwards.
/// Throws NumericalError.
inline CellShape published_dipole(const Config& config) {
  TissueState cell = published_start(config);
  TissueOde ode(cell.tissue, 0, dipole_options(config, cell), {});
  const int n = cell.tissue.vertex_count(), positions = 2 * n, size = ode.size();
  const double h = 0.01 * cell.tissue.mean_initial_rest_length() / std::sqrt(config.area.stiffness);
  std::vector<double>& y = cell.values;
  std::vector<double> velocity(size, 0.0), acceleration(size, 0.0), rate(size);
  const auto move = [&](int k) { return h * (velocity[k] + 0.5 * h * acceleration[k]); };
  const auto accelerate = [&](int k, double force) {
    const double half_way = velocity[k] + 0.5 * h * acceleration[k];
    acceleration[k] = (force - half_way) / (1.0 + 0.5 * h);
    velocity[k] = half_way + 0.5 * h * acceleration[k];
  };
  for (long steps = std::lround(config.dipole.duration / h); steps > 0; --steps) {
    for (int k = 0; k < positions; ++k) y[k] += move(k);
    if (ode.rate(0.0, y, rate) != Evaluation::ok) throw NumericalError(ode.refusal());
    const std::vector<double> pull = dipole_forces(config, cell);  // follows the centre of the vertices
    for (int k = positions; k < size; ++k) {
      const double moved = move(k);
      y[k] += moved;
      accelerate(k, rate[k] - moved / config.plasticity.tau);  // (l - l0)/tau with the new l0
    }
    for (int k = 0; k < positions; ++k) accelerate(k, rate[k] + (k < n ? pull[k] : 0.0));
  }
  return cell_shapes(cell.tissue, cell.view()).front();
}

}  // namespace suture::figures
