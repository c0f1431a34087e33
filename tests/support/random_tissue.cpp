#include "support/random_tissue.hpp"

#include <cmath>
#include <numbers>

namespace suture::test {

double uniform(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1.0p-53;
}

namespace {

/// A star-shaped outline with waves, around (center_x, center_y).
void add_outline(std::mt19937_64& engine, int count, double radius, double roughness, double center_x, double center_y,
                 std::vector<double>& x, std::vector<double>& y) {
  const double phase2 = uniform(engine, 0.0, 6.0), phase3 = uniform(engine, 0.0, 6.0),
               start = uniform(engine, 0.0, 6.0);
  for (int k = 0; k < count; ++k) {
    const double angle = start + 2.0 * std::numbers::pi * (k + uniform(engine, -0.15, 0.15)) / count;
    const double waves = std::sin(2 * angle + phase2) + std::sin(3 * angle + phase3) + uniform(engine, -1.0, 1.0);
    const double r = radius * (1.0 + roughness * waves);
    x.push_back(center_x + r * std::cos(angle));
    y.push_back(center_y + r * std::sin(angle));
  }
}

CellMaterial random_material(std::mt19937_64& engine) {
  return {.rest_area = uniform(engine, 0.8, 1.2),
          .area_stiffness = uniform(engine, 1.0, 20.0),
          .membrane_stiffness = uniform(engine, 0.5, 2.0),
          .bending_stiffness = uniform(engine, 0.01, 0.1),
          .tau = uniform(engine, 1.0, 50.0),
          .memory = uniform(engine, 0.0, 1.0)};
}

}  // namespace

TissueState random_tissue(std::uint64_t seed, const RandomTissueOptions& options) {
  std::mt19937_64 engine(seed);
  const double radius = std::sqrt(1.0 / std::numbers::pi);
  std::vector<int> counts;
  std::vector<CellMaterial> materials;
  std::vector<double> initial, x, y;
  for (int row = 0; row < options.rows; ++row)
    for (int column = 0; column < options.columns; ++column) {
      const int count = options.minimum_vertices +
                        static_cast<int>(uniform(engine, 0.0, options.maximum_vertices - options.minimum_vertices + 1));
      const double rest_length = regular_rest_length(count, 1.0, 1.2);
      const double pitch = options.spacing * (2.0 * radius + rest_length);
      add_outline(engine, count, radius, options.roughness,
                  pitch * (column + 0.5 * (row % 2)) + uniform(engine, -0.05, 0.05),
                  0.5 * std::numbers::sqrt3 * pitch * row + uniform(engine, -0.05, 0.05), x, y);
      counts.push_back(count);
      materials.push_back(random_material(engine));
      initial.insert(initial.end(), count, rest_length);
    }
  TissueState state{.tissue = Tissue(counts, std::move(materials), std::move(initial))};
  state.values = x;
  state.values.insert(state.values.end(), y.begin(), y.end());
  for (int v = 0; v < state.tissue.vertex_count(); ++v) {
    const int next = state.tissue.next(v);
    state.values.push_back(std::hypot(x[next] - x[v], y[next] - y[v]) *
                           (1.0 + uniform(engine, -options.strain, options.strain)));
  }
  return state;
}

std::vector<double> random_direction(const TissueState& state, std::uint64_t seed, double amplitude) {
  std::mt19937_64 engine(seed);
  std::vector<double> direction(state.layout().size(), 0.0);
  for (int i = 0; i < state.layout().positions(); ++i) direction[i] = uniform(engine, -amplitude, amplitude);
  return direction;
}

}  // namespace suture::test
