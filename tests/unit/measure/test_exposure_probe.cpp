// What saves looks at the exposure of all vertices, against such looks.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "measure/exposure_probe.hpp"
#include "support/wound_tissues.hpp"
#include "suture/measure/wound_neighbourhood.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Some cells shift as a whole, every vertex a little: membranes slide along each other and crevices open and close.
void drift(TissueState& state, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-amplitude, amplitude);
  const StateLayout layout = state.layout();
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell) {
    const double dx = shift(random), dy = shift(random);
    for (int v = state.tissue.first_vertex(cell); v < state.tissue.end_vertex(cell); ++v) state.values[layout.x(v)] += dx, state.values[layout.y(v)] += dy;
  }
  shake(state, 0.3 * amplitude, seed + 1000);
}

}  // namespace

TEST_CASE("who is surely still covered is covered", "[unit]") {
  int sure = 0, unsure = 0, gains = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    TissueState state = wounded_honeycomb(0.01, seed);
    WoundNeighbourhood edge(default_membrane());
    edge.update(state.tissue, state.view());
    CHECK_FALSE(edge.surely_uncovers_nobody(state.tissue, state.view()));  // the whole tissue was looked at, and is not kept
    edge.update(state.tissue, state.view());
    std::vector<char> before = edge.exposed_at_update();
    CHECK(edge.surely_uncovers_nobody(state.tissue, state.view()));
    for (unsigned k = 0; k < 60; ++k) {
      drift(state, k % 2 == 0 ? 2e-4 : 1e-3, 100 * seed + k);
      const bool said = edge.surely_uncovers_nobody(state.tissue, state.view());
      const Exposure whole = exposed_vertices(state.tissue, state.view(), default_membrane());
      const std::vector<char> now = edge.exposed(state.tissue, state.view());
      int uncovered = 0;
      for (int v = 0; v < state.tissue.vertex_count(); ++v) {
        CHECK((!now[v] || whole.exposed[v]));
        uncovered += now[v] && !before[v];
      }
      CAPTURE(seed, k, uncovered);
      if (said) CHECK(uncovered == 0);
      ++(said ? sure : unsure);
      gains += uncovered > 0;
      before = now;
    }
  }
  CAPTURE(sure, unsure, gains);
  CHECK(sure > 60);
  CHECK(gains > 20);
}

TEST_CASE("a probe of some vertices says what a look at all of them says", "[unit]") {
  std::mt19937 random(3);
  int exposed = 0, covered = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    TissueState state = wounded_honeycomb(0.01, seed);
    std::uniform_int_distribution<int> any(0, state.tissue.vertex_count() - 1);
    for (int k = 0; k < 100; ++k) {
      std::vector<int> vertices{any(random)};
      if (k % 3 == 0) vertices.push_back(any(random));
      ExposureProbe probe(state.tissue, state.view(), default_membrane(), vertices, {});
      TissueState moved = state;
      drift(moved, 2e-3, 1000 * seed + k);
      for (const TissueState* at : {&state, &moved}) {
        const Exposure whole = exposed_vertices(at->tissue, at->view(), default_membrane());
        bool any_exposed = false;
        for (const int v : vertices) any_exposed |= whole.exposed[v] != 0;
        CHECK((probe(at->view()) >= 0.0) == any_exposed);
        ++(any_exposed ? exposed : covered);
      }
    }
  }
  CHECK(exposed > 100);
  CHECK(covered > 100);
}

TEST_CASE("nobody counts as exposed because what covers him lies beside the box", "[unit]") {
  int exposed = 0;
  for (int k = 0; k < 40; ++k) {
    TissueState state = tissue_of(honeycomb({.rings = 5, .removed = [](Point p) { return std::hypot(p.x, p.y) < 1.2; }}));
    shake(state, 0.01, k + 1);
    move(state, 0.026 * k, 0.0, 0.0);
    WoundNeighbourhood edge(default_membrane());
    edge.update(state.tissue, state.view());
    edge.update(state.tissue, state.view());
    REQUIRE_FALSE(edge.cells().empty());
    const Exposure whole = exposed_vertices(state.tissue, state.view(), default_membrane());
    int wrong = 0;
    for (int v = 0; v < state.tissue.vertex_count(); ++v) {
      wrong += edge.exposed_at_update()[v] && !whole.exposed[v];
      exposed += edge.exposed_at_update()[v] != 0;
    }
    CAPTURE(k);
    CHECK(wrong == 0);
  }
  CHECK(exposed > 1000);
}
