#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "suture/errors.hpp"
#include "suture/measure/membrane.hpp"
#include "suture/simulate/cell_experiment.hpp"

namespace suture {

TissueState make_round_cell(const Config& config) {
  TissueState cell;
  cell.tissue = make_tissue(config);
  if (cell.tissue.cell_count() != 1)
    throw InputError(fmt::format("a one-cell experiment needs one cell, not {}", cell.tissue.cell_count()));
  const int n = cell.tissue.vertex_count();
  const double edge = cell.tissue.initial_rest_length(0);
  const double round = regular_rest_length(n, cell.tissue.material(0).rest_area, 1.0);
  if (std::abs(edge - round) > 1e-9 * round)
    throw InputError(
        fmt::format("key 'tissue.shape_parameter': found {:.6g}, allowed 1 in a one-cell experiment, which "
                    "starts from a round cell at rest",
                    edge * edge / (round * round)));
  const double radius = 0.5 * edge / std::sin(std::numbers::pi / n);
  cell.values.assign(cell.layout().size(), edge);
  const MutableStateView state = cell.mutable_view();
  for (int v = 0; v < n; ++v) {
    const double angle = std::numbers::pi * (0.5 + (2.0 * v + 1.0) / n);
    state.x[v] = radius * std::cos(angle);
    state.y[v] = radius * std::sin(angle);
  }
  return cell;
}

namespace {

std::vector<LoadPhase> compression_phases(const Config& config, const TissueState& cell) {
  const CompressionParameters& compression = config.compression;
  if (compression.closing_time > compression.duration)
    throw InputError(fmt::format("key 'compression.closing_time': found {}, allowed at most compression.duration = {}",
                                 compression.closing_time, compression.duration));
  const StateView state = cell.view();
  const auto [low, high] = std::minmax_element(state.y.begin(), state.y.end());
  const double range = config.packing.wall_range * make_membrane(config.contact, cell.tissue).contact_distance;
  const double diameter = *high - *low + 2.0 * range, gap = compression.gap * diameter;
  const ParallelPlates held{
      .center_y = 0.5 * (*low + *high), .gap = gap, .range = range, .energy = compression.plate_energy};
  ParallelPlates closing = held;
  closing.gap = diameter;
  closing.closing_speed = (diameter - gap) / compression.closing_time;
  closing.start_time = cell.time;
  const double closed = compression.closing_time, release = compression.duration;
  std::vector<LoadPhase> phases{{0.0, closed, closing}};
  if (release > closed) phases.push_back({closed, release, held});
  if (compression.recovery > 0.0) phases.push_back({release, release + compression.recovery, std::nullopt});
  return phases;
}

}  // namespace

std::vector<LoadPhase> load_phases(const Config& config, const TissueState& cell) {
  switch (config.run.protocol) {
    case Protocol::compression:
      return compression_phases(config, cell);
    case Protocol::dipole:
      return {{0.0, config.dipole.duration, std::nullopt}};
    case Protocol::wound_closure:
      break;
  }
  throw InputError("key 'run.protocol': found \"wound_closure\", allowed \"compression\" or \"dipole\" here");
}

std::vector<double> dipole_forces(const Config& config, const TissueState& cell) {
  const std::span<const double> x = cell.view().x;
  const double centre = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  // A vertex on the dividing axis must not be sorted by its rounding error.
  const double rounding = 1e-9 * cell.tissue.mean_initial_rest_length();
  std::vector<double> forces;
  for (const double position : x)
    forces.push_back(position < centre - rounding ? -config.dipole.force : config.dipole.force);
  return forces;
}

}  // namespace suture
