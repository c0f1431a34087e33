#include "suture/setup/ablation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "suture/errors.hpp"
#include "suture/measure/cell_shape.hpp"
#include "suture/measure/patch.hpp"

namespace suture {

std::vector<int> central_cells(const TissueState& state, int count) {
  const int cells = state.tissue.cell_count();
  if (count < 0 || count > cells)
    throw InputError(fmt::format("wound.cells: {} of {} cells cannot be ablated", count, cells));
  const Point centre = tissue_extents(state.tissue, state.view()).centre;
  std::vector<double> squared_distance;
  for (const CellShape& shape : cell_shapes(state.tissue, state.view())) {
    const double dx = shape.centre.x - centre.x, dy = shape.centre.y - centre.y;
    squared_distance.push_back(dx * dx + dy * dy);
  }
  std::vector<int> order(cells);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return squared_distance[a] < squared_distance[b]; });
  order.resize(count);
  return order;
}

TissueState remove_cells(const TissueState& state, const std::vector<int>& cells) {
  if (!state.purse_string.empty()) throw InputError("cells cannot be removed once the tissue has a purse string");
  std::vector<char> removed(state.tissue.cell_count(), 0);
  for (const int cell : cells) {
    if (cell < 0 || cell >= state.tissue.cell_count())
      throw InputError(
          fmt::format("cell {} cannot be removed: the tissue has cells 0 to {}", cell, state.tissue.cell_count() - 1));
    if (removed[cell]) throw InputError(fmt::format("cell {} is to be removed twice", cell));
    removed[cell] = 1;
  }
  std::vector<int> keep;
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell)
    if (!removed[cell]) keep.push_back(cell);
  if (keep.empty()) throw InputError(fmt::format("wound.cells: ablating all {} cells leaves no tissue", cells.size()));

  TissueState wounded;
  wounded.tissue = state.tissue.subset(keep);
  wounded.time = state.time;
  const auto append_surviving = [&](std::span<const double> values, std::vector<double>& out) {
    for (const int cell : keep)
      out.insert(out.end(), values.begin() + state.tissue.first_vertex(cell),
                 values.begin() + state.tissue.end_vertex(cell));
  };
  const StateView view = state.view();
  append_surviving(view.x, wounded.values);
  append_surviving(view.y, wounded.values);
  append_surviving(view.rest_length, wounded.values);
  std::vector<double> reference;
  if (!state.reference_rest_length.empty()) append_surviving(state.reference_rest_length, reference);
  wounded.reference_rest_length = std::move(reference);
  return wounded;
}

Ablated ablate(const Config& config, const TissueState& annealed, const Progress& progress,
               const StepWatch<RelaxationState>& watch) {
  Ablated ablated;
  ablated.removed = central_cells(annealed, config.wound.cells);
  ablated.state = remove_cells(annealed, ablated.removed);
  ablated.statistics = relax_overdamped(
      config, ablated.state, config.wound.relaxation_time,
      [&progress](double fraction, std::string_view text) { report_progress(progress, "ablation", fraction, text); }, watch);
  const std::span<const double> rest_lengths = ablated.state.view().rest_length;
  ablated.state.reference_rest_length = std::vector(rest_lengths.begin(), rest_lengths.end());
  return ablated;
}

}  // namespace suture
