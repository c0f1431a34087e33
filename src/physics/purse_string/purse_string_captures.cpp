#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "suture/physics/purse_string_operations.hpp"

namespace suture {

namespace {

std::unordered_map<int, int> ring_indices(const PurseString& purse_string) {
  std::unordered_map<int, int> index;
  for (int j = 0; j < purse_string.size(); ++j) index.emplace(purse_string.vertex[j], j);
  return index;
}

/// A new vertex and the springs it may go into: first, first + 1, ..., first + count - 1 (cyclic).
struct Placement {
  int vertex = 0, first = 0, count = 0;
};

/// The untethered vertices of the boundary, in its order from the first tethered one on.
std::vector<Placement> placements(const PurseString& purse_string, const std::vector<int>& boundary) {
  const std::unordered_map<int, int> index = ring_indices(purse_string);
  const auto tethered = [&](int v) { return index.contains(v); };
  const auto start = std::find_if(boundary.begin(), boundary.end(), tethered);
  if (start == boundary.end()) return {};

  const int size = purse_string.size();
  std::vector<char> exposed(size, 0);
  for (const int v : boundary)
    if (const auto found = index.find(v); found != index.end()) exposed[found->second] = 1;
  const auto springs_to_next_exposed = [&](int j) {
    int count = 1;
    while (!exposed[(j + count) % size]) ++count;
    return count;
  };

  std::vector<Placement> result;
  std::unordered_set<int> placed;
  int anchor = 0, count = 0;
  const std::size_t offset = start - boundary.begin();
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    const int v = boundary[(offset + k) % boundary.size()];
    if (const auto found = index.find(v); found != index.end()) {
      anchor = found->second;
      count = springs_to_next_exposed(anchor);
    } else if (placed.insert(v).second) {
      result.push_back({v, anchor, count});
    }
  }
  return result;
}

double cell_distance(const StateView& state, int v, int w) {
  return std::hypot(state.x[v] - state.x[w], state.y[v] - state.y[w]);
}

}  // namespace

std::vector<Capture> captures(const PurseString& purse_string, const std::vector<int>& boundary) {
  std::vector<Capture> result;
  for (const Placement& p : placements(purse_string, boundary)) result.push_back({p.vertex, p.first});
  return result;
}

std::vector<Capture> captures(const TissueState& state, const std::vector<int>& boundary) {
  const PurseString& string = state.purse_string;
  const StateView view = state.view();
  std::vector<Capture> result;
  int arc = -1, earliest = 0;
  for (const Placement& p : placements(string, boundary)) {
    if (p.first != arc) arc = p.first, earliest = 0;
    double least = std::numeric_limits<double>::infinity();
    int best = earliest;
    for (int k = earliest; k < p.count; ++k) {
      const int from = string.vertex[(p.first + k) % string.size()];
      const int to = string.vertex[(p.first + k + 1) % string.size()];
      const double detour =
          cell_distance(view, from, p.vertex) + cell_distance(view, p.vertex, to) - cell_distance(view, from, to);
      if (detour < least) least = detour, best = k;
    }
    earliest = best;
    result.push_back({p.vertex, (p.first + best) % string.size()});
  }
  return result;
}

}  // namespace suture
