#include "support/invariance.hpp"

#include <cmath>
#include <functional>
#include <numeric>

namespace suture::test {

namespace {

/// Renumbers cells, vertices and segments: cell i is old cell cells[i]; within it, vertex k is old vertex vertex_of(k,
/// n) and the segment that starts there is old segment segment_of(k, n).
Transformed renumbered(std::string name, const TissueState& state, const std::vector<int>& cells,
                       const std::function<int(int, int)>& vertex_of, const std::function<int(int, int)>& segment_of) {
  const Tissue& tissue = state.tissue;
  std::vector<int> counts, from, segment_from;
  std::vector<CellMaterial> materials;
  for (const int cell : cells) {
    const int first = tissue.first_vertex(cell), count = tissue.vertex_count(cell);
    counts.push_back(count);
    materials.push_back(tissue.material(cell));
    for (int k = 0; k < count; ++k) {
      from.push_back(first + (vertex_of(k, count) + count) % count);
      segment_from.push_back(first + (segment_of(k, count) + count) % count);
    }
  }
  const auto taken = [](std::span<const double> values, const std::vector<int>& indices) {
    std::vector<double> result;
    for (const int i : indices) result.push_back(values[i]);
    return result;
  };
  Transformed result{std::move(name), state, from};
  result.state.tissue = Tissue(counts, materials, taken(tissue.initial_rest_lengths(), segment_from));
  std::vector<int> new_number(tissue.vertex_count());
  for (int v = 0; v < tissue.vertex_count(); ++v) new_number[from[v]] = v;
  for (int& vertex : result.state.purse_string.vertex) vertex = new_number[vertex];
  for (int j = 0; j < state.purse_string.size(); ++j) result.point_from.push_back(state.layout().ring_point(j));
  if (!state.reference_rest_length.empty())
    result.state.reference_rest_length = taken(state.reference_rest_length, segment_from);
  const StateView old = state.view();
  result.state.values = taken(old.x, result.point_from);
  for (const auto& part : {taken(old.y, result.point_from), taken(old.rest_length, segment_from)})
    result.state.values.insert(result.state.values.end(), part.begin(), part.end());
  return result;
}

std::vector<int> in_order(int count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Turns every position by the map and records it.
Transformed mapped(Transformed transformed, Point image_of_x, Point image_of_y) {
  transformed.image_of_x = image_of_x, transformed.image_of_y = image_of_y;
  const MutableStateView view = transformed.state.mutable_view();
  for (std::size_t i = 0; i < view.x.size(); ++i) {
    const Point turned = transformed.turn({view.x[i], view.y[i]});
    view.x[i] = turned.x, view.y[i] = turned.y;
  }
  return transformed;
}

}  // namespace

Transformed translated(const TissueState& state, Point shift) {
  Transformed result{"translated", state, in_order(state.layout().points())};
  const MutableStateView view = result.state.mutable_view();
  for (double& x : view.x) x += shift.x;
  for (double& y : view.y) y += shift.y;
  return result;
}

Transformed rotated(const TissueState& state, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return mapped({"rotated", state, in_order(state.layout().points())}, {c, s}, {-s, c});
}

Transformed reflected(const TissueState& state) {
  // Reversed vertex k is old vertex -k; the segment from it leads to old vertex -k - 1, where that old segment starts.
  return mapped(renumbered(
                    "reflected", state, in_order(state.tissue.cell_count()), [](int k, int n) { return (n - k) % n; },
                    [](int k, int n) { return n - k - 1; }),
                {-1, 0}, {0, 1});
}

Transformed cycled(const TissueState& state, int shift) {
  const auto advance = [shift](int k, int n) { return (k + shift) % n; };
  return renumbered("vertices renumbered", state, in_order(state.tissue.cell_count()), advance, advance);
}

Transformed reordered(const TissueState& state) {
  std::vector<int> cells = in_order(state.tissue.cell_count());
  std::reverse(cells.begin(), cells.end());
  return reordered(state, cells);
}

Transformed reordered(const TissueState& state, const std::vector<int>& cells) {
  const auto same = [](int k, int) { return k; };
  return renumbered("cells renumbered", state, cells, same, same);
}

std::vector<Transformed> all_transformations(const TissueState& state) {
  return {translated(state, {3.7, -8.2}), rotated(state, 0.7), reflected(state), cycled(state, 4), reordered(state)};
}

TissueState scaled(const TissueState& state, double factor) {
  const Tissue& tissue = state.tissue;
  std::vector<int> counts;
  std::vector<CellMaterial> materials;
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    counts.push_back(tissue.vertex_count(cell));
    materials.push_back(tissue.material(cell));
    materials.back().rest_area *= factor * factor;
  }
  std::vector<double> initial(tissue.initial_rest_lengths().begin(), tissue.initial_rest_lengths().end());
  for (double& length : initial) length *= factor;
  TissueState result = state;
  result.tissue = Tissue(counts, materials, initial);
  for (double& value : result.values) value *= factor;
  return result;
}

std::vector<Point> point_gradient(const EnergyTerm& term, const TissueState& state) {
  std::vector<double> gradient(state.layout().size(), 0.0);
  const MutableStateView view(state.layout(), gradient);
  term.add_gradient(state.time, state.view(), view);
  std::vector<Point> result;
  for (int i = 0; i < state.layout().points(); ++i) result.push_back({view.x[i], view.y[i]});
  return result;
}

}  // namespace suture::test
