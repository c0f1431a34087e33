#include "measure/exposure_probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

/// The cells whose boxes come within two probe diameters of one of the vertices.
std::vector<int> cells_around(const Tissue& tissue, const StateView& state, double diameter, std::span<const int> vertices, std::span<const int> cells) {
  const double reach = 2.0 * diameter;
  std::vector<int> near;
  const auto look_at = [&](int cell) {
    const int first = tissue.first_vertex(cell), count = tissue.vertex_count(cell);
    const auto [left, right] = std::ranges::minmax(state.x.subspan(first, count));
    const auto [bottom, top] = std::ranges::minmax(state.y.subspan(first, count));
    if (std::ranges::any_of(vertices, [&](int v) {
          return state.x[v] > left - reach && state.x[v] < right + reach && state.y[v] > bottom - reach && state.y[v] < top + reach;
        }))
      near.push_back(cell);
  };
  for (const int cell : cells) look_at(cell);
  if (cells.empty())
    for (int cell = 0; cell < tissue.cell_count(); ++cell) look_at(cell);
  return near;
}

}  // namespace

ExposureProbe::ExposureProbe(const Tissue& tissue, const StateView& state, const Membrane& membrane, std::span<const int> vertices,
                             std::span<const int> cells)
    : membrane_(membrane), cells_(cells_around(tissue, state, 2.0 * membrane.probe_radius(), vertices, cells)), part_(tissue.subset(cells_)) {
  for (const int cell : cells_)
    for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) {
      vertex_.push_back(v);
      watched_.push_back(std::find(vertices.begin(), vertices.end(), v) != vertices.end());
    }
  x_.resize(vertex_.size());
  y_.resize(vertex_.size());
}

double ExposureProbe::operator()(const StateView& state) {
  for (std::size_t k = 0; k < vertex_.size(); ++k) x_[k] = state.x[vertex_[k]], y_[k] = state.y[vertex_[k]];
  StateView view;
  view.x = x_, view.y = y_;
  grid_.build(part_, view, grid_bucket_size(membrane_));
  measure_exposure(part_, view, grid_, membrane_, ExposureRule::probe_disc, watched_, exposure_);
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < vertex_.size(); ++k) {
    if (!watched_[k]) continue;
    // What is within rounding of a probe's radius counts as the flag says.
    const double margin = exposure_.margin[k];
    largest = std::max(largest, exposure_.exposed[k] ? std::max(margin, 0.0) : std::min(margin, -std::numeric_limits<double>::min()));
  }
  return largest;
}

}  // namespace suture
