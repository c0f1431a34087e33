#include <catch2/catch.hpp>
#include <cmath>

#include "support/wound_tissues.hpp"
#include "suture/measure/grid_wound.hpp"
#include "suture/measure/wound.hpp"

using namespace suture;
using namespace suture::test;

namespace {

TissueState round_hole(double radius) {
  return tissue_of(sector_ring({.cells = 8,
                                .inner = [=](double) { return radius; },
                                .outer = [=](double) { return radius + 1.0; },
                                .gap = 0.02,
                                .inner_points = 12}));
}

/// A hole of two lobes joined by a neck 2 `neck` wide; the right lobe is the larger by `skew`.
TissueState two_lobes(double neck, double skew) {
  const auto inner = [=](double angle) {
    const double c = std::cos(angle);
    return neck + (1.2 + skew * c) * c * c;
  };
  return tissue_of(sector_ring({.cells = 10, .inner = inner, .outer = [=](double a) { return inner(a) + 1.0; }, .gap = 0.08, .inner_points = 25}));
}

}  // namespace

TEST_CASE("the flood fill finds the area of the wound to its resolution", "[unit]") {
  const Membrane m = default_membrane();
  for (const double radius : {0.7, 1.0, 1.4}) {
    const TissueState state = round_hole(radius);
    GridWound grid(m);
    grid.set_seed({0.01, -0.02});
    const double exact = find_wound(state.tissue, state.view(), m)->area;
    // One row of grid points around the edge, and the squares reach up to 0.41 s/2 beyond the discs.
    CHECK(grid.update(state.tissue, state.view()) == Approx(exact).margin(2.0 * 3.1416 * radius * 0.5 * m.half_width()));
  }
}

TEST_CASE("beside the wound are the vertices of its edge and no others", "[unit]") {
  const TissueState state = round_hole(1.0);
  GridWound grid(default_membrane());
  grid.set_seed({0.0, 0.0});
  grid.update(state.tissue, state.view());
  int inner = 0;
  for (int v = 0; v < state.tissue.vertex_count(); ++v) {
    const double r = std::hypot(state.view().x[v], state.view().y[v]);
    if (r < 1.001) {
      ++inner;
      CHECK(grid.beside(state.view(), v));
    }
    if (r > 1.0 + 4.0 * default_membrane().half_width()) CHECK_FALSE(grid.beside(state.view(), v));
  }
  CHECK(inner > 50);
}

TEST_CASE("a wound that splits goes on as the part that holds the seed, or as the larger one when that is small", "[unit]") {
  const Membrane m = default_membrane();
  const TissueState open = two_lobes(0.3, 0.15), split = two_lobes(0.0, 0.15);
  const auto area_from = [&](Point seed) {
    GridWound grid(m);
    grid.set_seed(seed);
    const double before = grid.update(open.tissue, open.view());
    const double after = grid.update(split.tissue, split.view());
    CHECK(after < before);
    return after;
  };
  const double right = area_from({0.8, 0.0});
  CHECK(right > 0.3);
  CHECK(area_from({0.0, 0.0}) == Approx(right).epsilon(1e-12));   // the seed itself is covered
  CHECK(area_from({-0.8, 0.0}) == Approx(right).epsilon(1e-12));  // less than half was left at the seed
}

TEST_CASE("no wound where everything is covered", "[unit]") {
  const TissueState state = round_hole(1.0);
  GridWound grid(default_membrane());
  grid.set_seed({1.5 * std::cos(0.39), 1.5 * std::sin(0.39)});  // in the middle of a cell
  CHECK(grid.update(state.tissue, state.view()) == 0.0);
  for (int v = 0; v < state.tissue.vertex_count(); ++v) CHECK_FALSE(grid.beside(state.view(), v));
}
