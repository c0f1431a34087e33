#include "suture/measure/neighbours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "measure/segment_grid.hpp"
#include "suture/errors.hpp"

namespace suture {
namespace {

CellPair ordered(int a, int b) { return a < b ? CellPair{a, b} : CellPair{b, a}; }

int find_root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

bool near_box(const BoundingBox& box, double x, double y, double reach) {
  return x >= box.x_low - reach && x <= box.x_high + reach && y >= box.y_low - reach && y <= box.y_high + reach;
}

/// Whether a vertex of `own` is within reach of the membrane of `other`.
bool vertex_meets(const Tissue& tissue, const SegmentGrid& grid, int own, int other, double reach) {
  const BoundingBox& box = grid.box(other);
  for (int v = tissue.first_vertex(own); v < tissue.end_vertex(own); ++v) {
    const double x = grid[v].ax, y = grid[v].ay;
    if (!near_box(box, x, y, reach)) continue;
    for (int s = tissue.first_vertex(other); s < tissue.end_vertex(other); ++s)
      if (grid[s].squared_distance(x, y) <= reach * reach) return true;
  }
  return false;
}

}  // namespace

ContactGraph::ContactGraph(int cells, std::vector<CellPair> pairs) : cells_(cells), pairs_(std::move(pairs)) {
  for (CellPair& pair : pairs_) {
    pair = ordered(pair.first, pair.second);
    if (pair.first < 0 || pair.second >= cells || pair.first == pair.second)
      throw InputError(
          fmt::format("cells {} and {} cannot touch in a tissue of {} cells", pair.first, pair.second, cells));
  }
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
}

bool ContactGraph::contains(int a, int b) const {
  return std::binary_search(pairs_.begin(), pairs_.end(), ordered(a, b));
}

void ContactGraph::insert(CellPair pair) {
  const auto place = std::lower_bound(pairs_.begin(), pairs_.end(), pair);
  if (place == pairs_.end() || *place != pair) pairs_.insert(place, pair);
}

void ContactGraph::erase(CellPair pair) {
  const auto place = std::lower_bound(pairs_.begin(), pairs_.end(), pair);
  if (place != pairs_.end() && *place == pair) pairs_.erase(place);
}

int ContactGraph::components(std::vector<int>& component) const {
  std::vector<int> parent(cells_);
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& [a, b] : pairs_) parent[find_root(parent, a)] = find_root(parent, b);
  component.assign(cells_, -1);
  std::vector<int> label(cells_, -1);
  int count = 0;
  for (int i = 0; i < cells_; ++i) {
    int& root_label = label[find_root(parent, i)];
    if (root_label < 0) root_label = count++;
    component[i] = root_label;
  }
  return count;
}

ContactGraph contact_graph(const Tissue& tissue, const StateView& state, const Membrane& membrane) {
  return contact_graph(tissue, state, membrane, {}, membrane.interaction_distance());
}

ContactGraph contact_graph(const Tissue& tissue, const StateView& state, const Membrane& membrane,
                           const ContactGraph& previous, double release_distance) {
  const double contact = membrane.interaction_distance();
  if (!(release_distance >= contact))
    throw InputError(fmt::format("release distance {} is below the contact distance {}", release_distance, contact));
  SegmentGrid grid;
  grid.build_unsorted(tissue, state);
  std::vector<CellPair> pairs;
  grid.visit_box_pairs(release_distance, [&](int a, int b) {
    const double reach = previous.contains(a, b) ? release_distance : contact;
    if (vertex_meets(tissue, grid, a, b, reach) || vertex_meets(tissue, grid, b, a, reach)) pairs.emplace_back(a, b);
  });
  return {tissue.cell_count(), std::move(pairs)};
}

std::vector<Exchange> neighbour_exchanges(const ContactGraph& before, const ContactGraph& after) {
  std::vector<CellPair> lost, gained;
  std::ranges::set_difference(before.pairs(), after.pairs(), std::back_inserter(lost));
  std::ranges::set_difference(after.pairs(), before.pairs(), std::back_inserter(gained));
  std::vector<Exchange> exchanges;
  for (const CellPair& part : lost) {
    const auto meets_both = [&](int cell) {
      return after.contains(cell, part.first) && after.contains(cell, part.second);
    };
    const auto partner = std::ranges::find_if(
        gained, [&](const CellPair& meet) { return meets_both(meet.first) && meets_both(meet.second); });
    if (partner == gained.end()) continue;
    exchanges.push_back({part, *partner});
    gained.erase(partner);
  }
  return exchanges;
}

std::vector<Exchange> ExchangeCounter::update(const ContactGraph& graph) {
  if (!started_) reference_ = graph;
  started_ = true;
  std::vector<Exchange> exchanges = neighbour_exchanges(reference_, graph);
  for (const Exchange& exchange : exchanges) {
    reference_.erase(exchange.lost);
    reference_.insert(exchange.gained);
  }
  count_ += static_cast<long>(exchanges.size());
  return exchanges;
}

int rosette_order(const Tissue& tissue, const StateView& state, double radius) {
  if (!(radius > 0.0)) throw InputError(fmt::format("rosette radius {} is not positive", radius));
  SegmentGrid grid;
  grid.build(tissue, state, radius);
  std::vector<CellPair> seen;  // (vertex, cell)
  for (int v = 0; v < tissue.vertex_count(); ++v) {
    const double x = state.x[v], y = state.y[v];
    grid.visit_near({x, x, y, y}, radius, [&](int segment) {
      const int other = grid[segment].cell;
      if (other != tissue.cell_of(v) && grid[segment].squared_distance(x, y) <= radius * radius) seen.emplace_back(v, other);
      return false;
    });
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  int most = 0, here = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    here = i > 0 && seen[i].first == seen[i - 1].first ? here + 1 : 1;
    most = std::max(most, here);
  }
  return tissue.cell_count() > 0 ? most + 1 : 0;
}

}  // namespace suture
