// Where the published program inserts a captured vertex into the ring (tandrewton/dpm, epi2D::updatePurseStringContacts).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "suture/physics/purse_string_operations.hpp"

namespace suture {

namespace {

/// Indices of two ring vertices.
using Pair = std::pair<int, int>;

class Insertion {
 public:
  Insertion(const TissueState& state, int vertex)
      : tissue_(state.tissue), string_(state.purse_string), view_(state.view()), vertex_(vertex), cell_(tissue_.cell_of(vertex)) {}

  std::optional<int> after() const {
    std::optional<Pair> pair = along_membrane();
    if (!pair) pair = by_distance();
    if (!pair) return std::nullopt;
    const auto [first, second] = *pair;
    const bool over_seam = std::min(first, second) == 0 && std::max(first, second) == size() - 1;
    return over_seam ? size() - 1 : std::min(first, second);
  }

 private:
  int size() const { return string_.size(); }
  int cell_of_ring(int j) const { return tissue_.cell_of(string_.vertex[j]); }
  int position(int vertex) const {
    const auto found = std::find(string_.vertex.begin(), string_.vertex.end(), vertex);
    return found == string_.vertex.end() ? -1 : static_cast<int>(found - string_.vertex.begin());
  }
  bool adjacent(int j, int k) const {
    const int apart = std::abs(j - k);
    return apart == 1 || apart == size() - 1;
  }

  /// Whether both of ring vertices j, k are met within a third of the cell's vertices, one in either direction.
  bool fits_between(int j, int k) const {
    const int reach = static_cast<int>(tissue_.vertex_count(cell_) / 3.0);
    bool ahead = false, behind = false;
    for (int i = 0, v = tissue_.next(vertex_), w = tissue_.previous(vertex_); i < reach; ++i, v = tissue_.next(v), w = tissue_.previous(w)) {
      ahead |= v == string_.vertex[j] || v == string_.vertex[k];
      behind |= w == string_.vertex[j] || w == string_.vertex[k];
    }
    return ahead && behind;
  }

  /// Beside a neighbour on its own membrane that is in the ring.
  std::optional<Pair> along_membrane() const {
    const int before = position(tissue_.previous(vertex_)), behind = position(tissue_.next(vertex_));
    if (before >= 0 && behind >= 0) return Pair{before, behind};
    const int neighbour = before >= 0 ? before : behind;
    if (neighbour < 0) return std::nullopt;
    for (const int other : {(neighbour + size() - 1) % size(), (neighbour + 1) % size()})
      if (cell_of_ring(other) == cell_ && fits_between(neighbour, other)) return Pair{neighbour, other};
    return std::nullopt;
  }

  /// The three ring vertices whose cell vertices are nearest.
  std::array<int, 3> nearest() const {
    std::vector<std::pair<double, int>> distances;
    for (int j = 0; j < size(); ++j) {
      const double dx = view_.x[vertex_] - view_.x[string_.vertex[j]], dy = view_.y[vertex_] - view_.y[string_.vertex[j]];
      distances.emplace_back(dx * dx + dy * dy, j);
    }
    std::partial_sort(distances.begin(), distances.begin() + 3, distances.end());
    return {distances[0].second, distances[1].second, distances[2].second};
  }

  bool next_on_membrane(int j, int k) const {
    const int apart = std::abs(string_.vertex[j] - string_.vertex[k]);
    return cell_of_ring(j) == cell_of_ring(k) && (apart == 1 || apart == tissue_.vertex_count(cell_) - 1);
  }

  /// Between two of the three nearest that are neighbours in the ring but not on one membrane.
  std::optional<Pair> by_distance() const {
    auto [first, second, third] = nearest();
    if (!adjacent(first, second) || next_on_membrane(first, second)) {
      if (adjacent(first, third))
        second = third;
      else if (adjacent(second, third))
        first = second, second = third;
      else
        return std::nullopt;
    }
    if (cell_of_ring(first) != cell_of_ring(second)) return Pair{first, second};
    if (next_on_membrane(first, second)) return std::nullopt;
    // Counted with vertex numbers of the whole tissue, so a vertex of another cell far up the list passes.
    int near = 0;
    for (const int j : {first, second}) {
      const int apart = std::abs(vertex_ - string_.vertex[j]);
      near += (apart <= 2) + (tissue_.vertex_count(cell_) - apart <= 2);
    }
    if (near < 2) return std::nullopt;
    return Pair{first, second};
  }

  const Tissue& tissue_;
  const PurseString& string_;
  StateView view_;
  int vertex_, cell_;
};

}  // namespace

std::optional<int> published_insertion(const TissueState& state, int vertex) {
  if (state.purse_string.size() < smallest_ring) return std::nullopt;
  return Insertion(state, vertex).after();
}

}  // namespace suture
