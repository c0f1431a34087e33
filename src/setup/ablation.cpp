#include "suture/setup/ablation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "suture/errors.hpp"

namespace suture {

namespace {

struct Moments {
  double area = 0.0, x = 0.0, y = 0.0;  ///< area, and area times centroid
};

Moments cell_moments(const TissueState& state, int cell) {
  const StateView view = state.view();
  Moments sum;
  for (int v = state.tissue.first_vertex(cell); v < state.tissue.end_vertex(cell); ++v) {
    const int w = state.tissue.next(v);
    const double triangle = 0.5 * (view.x[v] * view.y[w] - view.x[w] * view.y[v]);
    sum.area += triangle;
    sum.x += triangle * (view.x[v] + view.x[w]) / 3.0;
    sum.y += triangle * (view.y[v] + view.y[w]) / 3.0;
  }
  return sum;
}

}  // namespace

std::vector<int> central_cells(const TissueState& state, int count) {
  const int cells = state.tissue.cell_count();
  if (count < 0 || count > cells)
    throw InputError(fmt::format("wound.cells: {} of {} cells cannot be ablated", count, cells));
  std::vector<Moments> moments;
  Moments total;
  for (int cell = 0; cell < cells; ++cell) {
    moments.push_back(cell_moments(state, cell));
    total.area += moments[cell].area, total.x += moments[cell].x, total.y += moments[cell].y;
  }
  std::vector<double> squared_distance;
  for (const Moments& m : moments) {
    const double dx = m.x / m.area - total.x / total.area, dy = m.y / m.area - total.y / total.area;
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
      throw InputError(fmt::format("cell {} cannot be removed: the tissue has cells 0 to {}", cell,
                                   state.tissue.cell_count() - 1));
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
  if (!state.reference_rest_length.empty())
    append_surviving(state.reference_rest_length, wounded.reference_rest_length);
  return wounded;
}

}  // namespace suture
