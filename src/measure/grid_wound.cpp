#include "suture/measure/grid_wound.hpp"

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr int occupied = -1, free_point = 0;
constexpr int seed_search = 5;      // grid points
constexpr int window = 4;           // r / spacing + 2
constexpr double largest_drop = 0.5;

}  // namespace

GridWound::GridWound(const Membrane& membrane) : radius_(membrane.half_width()), spacing_(0.5 * membrane.half_width()) {}

void GridWound::lay_grid(const Tissue& tissue, const StateView& state) {
  const auto vertices = static_cast<std::size_t>(tissue.vertex_count());
  const auto [x_low, x_high] = std::minmax_element(state.x.begin(), state.x.begin() + vertices);
  const auto [y_low, y_high] = std::minmax_element(state.y.begin(), state.y.begin() + vertices);
  column_low_ = cell_of(*x_low);
  row_low_ = cell_of(*y_low);
  columns_ = static_cast<int>(std::ceil(*x_high / spacing_)) - column_low_ + 1;
  rows_ = static_cast<int>(std::ceil(*y_high / spacing_)) - row_low_ + 1;
  label_.assign(static_cast<std::size_t>(columns_) * rows_, free_point);
}

/// Row by row: a point is inside when a ray from it crosses the membrane an odd number of times.
void GridWound::occupy_cell(const Tissue& tissue, const StateView& state, int cell) {
  const int first = tissue.first_vertex(cell), end = tissue.end_vertex(cell);
  const auto [low, high] = std::minmax_element(state.y.begin() + first, state.y.begin() + end);
  for (int row = static_cast<int>(std::ceil(*low / spacing_)); row <= cell_of(*high); ++row) {
    const double y = row * spacing_;
    crossings_.clear();
    for (int a = end - 1, b = first; b < end; a = b++)
      if ((state.y[a] > y) != (state.y[b] > y))
        crossings_.push_back(state.x[a] + (y - state.y[a]) / (state.y[b] - state.y[a]) * (state.x[b] - state.x[a]));
    std::sort(crossings_.begin(), crossings_.end());
    for (std::size_t k = 0; k + 1 < crossings_.size(); k += 2)
      for (int column = static_cast<int>(std::ceil(crossings_[k] / spacing_)); column * spacing_ < crossings_[k + 1]; ++column)
        label_[index(column, row)] = occupied;
  }
}

void GridWound::occupy(const Tissue& tissue, const StateView& state) {
  for (int cell = 0; cell < tissue.cell_count(); ++cell) occupy_cell(tissue, state, cell);
  for (int v = 0; v < tissue.vertex_count(); ++v) {
    const int column = cell_of(state.x[v]), row = cell_of(state.y[v]);
    for (int j = row - 2; j <= row + 3; ++j)
      for (int i = column - 2; i <= column + 3; ++i)
        if (inside(i, j) && std::abs(i * spacing_ - state.x[v]) < radius_ && std::abs(j * spacing_ - state.y[v]) < radius_)
          label_[index(i, j)] = occupied;
  }
}

/// Gives `label` to the component of `start`; returns its number of points.
int GridWound::flood(int start, int label) {
  int count = 0;
  stack_.assign(1, start);
  label_[start] = label;
  while (!stack_.empty()) {
    const int k = stack_.back(), column = k % columns_;
    stack_.pop_back();
    ++count;
    const auto visit = [&](bool exists, int neighbour) {
      if (!exists || label_[neighbour] != free_point) return;
      label_[neighbour] = label;
      stack_.push_back(neighbour);
    };
    visit(column > 0, k - 1);
    visit(column + 1 < columns_, k + 1);
    visit(k >= columns_, k - columns_);
    visit(k + columns_ < columns_ * rows_, k + columns_);
  }
  return count;
}

/// The grid point of the seed or a free one near it; -1 when all are occupied.
int GridWound::at_seed() const {
  const int column = cell_of(seed_.x), row = cell_of(seed_.y);
  const auto is_free = [&](int i, int j) { return inside(i, j) && label_[index(i, j)] == free_point; };
  if (is_free(column, row)) return index(column, row);
  for (int offset = 1; offset <= seed_search; ++offset)
    for (const int i : {column + offset, column, column - offset})
      for (const int j : {row + offset, row, row - offset})
        if (is_free(i, j)) return index(i, j);
  return -1;
}

/// Label of the component with the most points in common with the wound before; -1 when there is none.
int GridWound::largest_overlap() {
  int best = -1, most = 0, label = 2;
  for (std::size_t k = 0; k + 1 < before_.size(); k += 2) {
    if (!inside(before_[k], before_[k + 1])) continue;
    const int start = index(before_[k], before_[k + 1]);
    if (label_[start] != free_point) continue;
    flood(start, label);
    int common = 0;
    for (std::size_t m = 0; m + 1 < before_.size(); m += 2)
      common += inside(before_[m], before_[m + 1]) && label_[index(before_[m], before_[m + 1])] == label;
    if (common > most) most = common, best = label;
    ++label;
  }
  return best;
}

void GridWound::remember() {
  before_.clear();
  if (wound_ == 0) return;
  for (std::size_t k = 0; k < label_.size(); ++k)
    if (label_[k] == wound_) {
      before_.push_back(static_cast<int>(k) % columns_ + column_low_);
      before_.push_back(static_cast<int>(k) / columns_ + row_low_);
    }
}

double GridWound::update(const Tissue& tissue, const StateView& state) {
  remember();
  lay_grid(tissue, state);
  occupy(tissue, state);
  const double point_area = spacing_ * spacing_;
  int start = at_seed();
  wound_ = 1;
  double area = start >= 0 ? flood(start, wound_) * point_area : 0.0;
  if (!before_.empty() && area < largest_drop * area_) {
    const int other = largest_overlap();
    const double other_area = static_cast<double>(std::count(label_.begin(), label_.end(), other)) * point_area;
    if (other > 0 && other_area > area) {
      wound_ = other;
      area = other_area;
      start = static_cast<int>(std::find(label_.begin(), label_.end(), other) - label_.begin());
    }
  }
  if (area > 0.0)
    seed_ = {(start % columns_ + column_low_ + 0.5) * spacing_, (start / columns_ + row_low_ + 0.5) * spacing_};
  else
    wound_ = 0;
  return area_ = area;
}

bool GridWound::beside(const StateView& state, int vertex) const {
  if (wound_ == 0) return false;
  const int column = cell_of(state.x[vertex]), row = cell_of(state.y[vertex]);
  for (int j = row - window; j < row + window; ++j)
    for (int i = column - window; i < column + window; ++i)
      if (inside(i, j) && label_[index(i, j)] == wound_) return true;
  return false;
}

}  // namespace suture
