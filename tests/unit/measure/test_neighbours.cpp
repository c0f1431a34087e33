#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "support/wound_tissues.hpp"
#include "suture/errors.hpp"
#include "suture/geometry/point_segment.hpp"
#include "suture/measure/neighbours.hpp"

using namespace suture;
using namespace suture::test;

namespace {

Point point_at(const StateView& view, int v) { return {view.x[v], view.y[v]}; }

/// Four discs of radius 1: 0 and 1 left and right of the origin, 2 and 3 above and below; every pair of neighbours on
/// the rim touches; `shift` > 0 brings 0 and 1 together, < 0 brings 2 and 3 together.
TissueState four_cells(double shift) {
  const double touch = 2.05 / std::numbers::sqrt2;
  const double half_x = touch - shift, half_y = std::sqrt(2.05 * 2.05 - half_x * half_x);
  std::vector<Polygon> cells;
  for (const Point c : {Point{-half_x, 0}, Point{half_x, 0}, Point{0, half_y}, Point{0, -half_y}}) {
    Polygon disc;
    for (int i = 0; i < 96; ++i)
      disc.push_back({c.x + std::cos(2 * std::numbers::pi * i / 96), c.y + std::sin(2 * std::numbers::pi * i / 96)});
    cells.push_back(disc);
  }
  return tissue_of(cells);
}

const Membrane membrane{.contact_distance = 0.1, .range = 0.3};
constexpr double closest = 2.05 / std::numbers::sqrt2 - 1.04;  // shift at which 0 and 1 are 0.08 apart

}  // namespace

TEST_CASE("contacts of four cells and the exchange between their two pairings", "[unit]") {
  const TissueState before = four_cells(closest), after = four_cells(-closest);
  const ContactGraph a = contact_graph(before.tissue, before.view(), membrane);
  const ContactGraph b = contact_graph(after.tissue, after.view(), membrane);
  CHECK(a.pairs().size() == 5);
  CHECK(a.contains(1, 0));
  CHECK_FALSE(a.contains(2, 3));
  CHECK(b.contains(2, 3));
  CHECK(neighbour_exchanges(a, b) == std::vector<Exchange>{{{0, 1}, {2, 3}}});
  CHECK(neighbour_exchanges(a, a).empty());
}

TEST_CASE("one exchange is counted once however it is sampled", "[unit]") {
  for (const int samples : {2, 9, 40}) {
    ExchangeCounter counter;
    ContactGraph graph;
    for (int i = 0; i < samples; ++i) {
      const TissueState state = four_cells(closest * (1.0 - 2.0 * i / (samples - 1)));
      graph = contact_graph(state.tissue, state.view(), membrane, graph, 0.2);
      counter.update(graph);
    }
    CHECK(counter.count() == 1);
  }
}

TEST_CASE("hysteresis holds a contact until the cells are clearly apart", "[unit]") {
  ContactGraph graph;
  const auto at_gap = [](double gap) { return four_cells(2.05 / std::numbers::sqrt2 - 1.0 - 0.5 * gap); };
  int held = 0, plain = 0;
  for (const double gap : {0.14, 0.12, 0.14, 0.12, 0.14, 0.19, 0.21, 0.14}) {
    const TissueState state = at_gap(gap);
    graph = contact_graph(state.tissue, state.view(), membrane, graph, 0.2);
    held += graph.contains(0, 1);
    plain += contact_graph(state.tissue, state.view(), membrane).contains(0, 1);
  }
  CHECK(held == 5);
  CHECK(plain == 2);
}

TEST_CASE("pairs that take turns are exchanges only when they let go", "[unit]") {
  ExchangeCounter with, without;
  ContactGraph graph;
  for (int i = 0; i < 20; ++i) {
    const TissueState state = four_cells(i % 2 ? closest : -closest);  // the open pair is 1.5 apart
    graph = contact_graph(state.tissue, state.view(), membrane, graph, 1.6);
    with.update(graph);
    without.update(contact_graph(state.tissue, state.view(), membrane));
  }
  CHECK(with.count() == 0);
  CHECK(without.count() == 19);
}

TEST_CASE("contacts lost to the wound or gained across it are no exchanges", "[unit]") {
  const ContactGraph ring(4, {{0, 1}, {1, 2}, {2, 3}, {0, 3}});
  CHECK(neighbour_exchanges(ring, ContactGraph(4, {{0, 1}, {1, 2}, {2, 3}})).empty());
  CHECK(neighbour_exchanges(ring, ContactGraph(4, {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 2}})).empty());
}

TEST_CASE("contacts are those of every vertex against every segment", "[unit]") {
  const Membrane m = default_membrane();
  const double release = 1.5 * m.interaction_distance();
  ContactGraph held;
  std::size_t fewest = 1000, most = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    TissueState state = tissue_of(honeycomb({.rings = 3, .gap = 0.12 + 0.02 * seed}));
    shake(state, 0.02, seed);
    const auto brute_force = [&](const ContactGraph& previous) {
      std::vector<CellPair> pairs;
      for (int v = 0; v < state.tissue.vertex_count(); ++v)
        for (int a = 0; a < state.tissue.vertex_count(); ++a) {
          const int own = state.tissue.cell_of(v), other = state.tissue.cell_of(a);
          if (own == other) continue;
          const double reach = previous.contains(own, other) ? release : m.interaction_distance();
          const int b = state.tissue.next(a);
          if (point_segment_distance(point_at(state.view(), v), point_at(state.view(), a), point_at(state.view(), b)) <= reach)
            pairs.emplace_back(own, other);
        }
      return ContactGraph(state.tissue.cell_count(), pairs);
    };
    const ContactGraph plain = contact_graph(state.tissue, state.view(), m);
    CHECK(std::ranges::equal(plain.pairs(), brute_force({}).pairs()));
    const ContactGraph expected = brute_force(held);
    held = contact_graph(state.tissue, state.view(), m, held, release);
    CHECK(std::ranges::equal(held.pairs(), expected.pairs()));
    fewest = std::min(fewest, plain.pairs().size()), most = std::max(most, held.pairs().size());
  }
  CHECK(fewest + 10 < most);
}

TEST_CASE("connected components of a contact graph", "[unit]") {
  std::vector<int> component;
  CHECK(ContactGraph(5, {{0, 3}, {3, 4}, {1, 2}, {3, 0}}).components(component) == 2);
  CHECK(component == std::vector<int>{0, 1, 1, 0, 0});
  CHECK_THROWS_AS(ContactGraph(3, {{0, 3}}), InputError);
  CHECK_THROWS_AS(ContactGraph(3, {{1, 1}}), InputError);
}

TEST_CASE("a cell of a honeycomb has six neighbours and junctions of three", "[unit]") {
  const TissueState state = tissue_of(honeycomb({.rings = 2}));
  const ContactGraph graph = contact_graph(state.tissue, state.view(), default_membrane());
  REQUIRE(state.tissue.cell_count() == 19);
  CHECK(graph.pairs().size() == 42);
  CHECK(rosette_order(state.tissue, state.view(), 0.2) == 3);
  const TissueState ring =
      tissue_of(sector_ring({.cells = 6, .inner = [](double) { return 0.15; }, .outer = [](double) { return 1.5; }}));
  CHECK(rosette_order(ring.tissue, ring.view(), 0.35) == 6);
  CHECK_THROWS_AS(rosette_order(ring.tissue, ring.view(), 0.0), InputError);
  CHECK_THROWS_AS(contact_graph(ring.tissue, ring.view(), default_membrane(), {}, 0.01), InputError);
}
