// The wound from the cells around it against the wound from the whole tissue.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "support/wound_tissues.hpp"
#include "suture/measure/wound_neighbourhood.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Both followers see the same states and must agree, bit for bit. Where walls are exactly parallel and a probe apart, somewhere in the
/// tissue, the whole is measured with a probe larger by 1e-9.
struct Followers {
  WoundNeighbourhood part{default_membrane()};
  WoundTracker whole{default_membrane()};
  double tolerance = 0.0;  // relative

  void see(const TissueState& state) {
    const auto& a = part.update(state.tissue, state.view());
    const auto& b = whole.update(state.tissue, state.view());
    REQUIRE(a.has_value() == b.has_value());
    CHECK(part.status() == whole.status());
    if (!a) return;
    CHECK(std::abs(a->area - b->area) <= tolerance * b->area);
    CHECK(std::abs(a->perimeter - b->perimeter) <= tolerance * b->perimeter);
    CHECK(std::abs(a->area_of_parts - b->area_of_parts) <= tolerance * b->area_of_parts);
    CHECK(a->parts == b->parts);
    CHECK(a->boundary == b->boundary);
    CHECK(part.exposed_at_update() == part.exposed(state.tissue, state.view()));
  }
};

/// 84 cells around a wound of seven.
TissueState wide_honeycomb() {
  return tissue_of(honeycomb({.rings = 5, .removed = [](Point p) { return std::hypot(p.x, p.y) < 1.2; }}));
}

void move_cell(TissueState& state, int cell, double dx, double dy) {
  const StateLayout layout = state.layout();
  for (int v = state.tissue.first_vertex(cell); v < state.tissue.end_vertex(cell); ++v)
    state.values[layout.x(v)] += dx, state.values[layout.y(v)] += dy;
}

}  // namespace

TEST_CASE("a wound that moves is followed from the cells around it", "[unit]") {
  TissueState state = wide_honeycomb();
  Followers followers;
  followers.see(state);
  CHECK(followers.part.cells().empty());
  for (const double step : {0.01, 0.05, 0.1}) {
    move(state, 0.0, step, -0.5 * step);
    followers.see(state);
    CHECK(followers.part.cells().size() > 6);
    CHECK(followers.part.cells().size() < 40);
  }
  move(state, 0.3, 0.3, 0.2);  // too far for the region that was looked at
  followers.see(state);
  CHECK(followers.part.cells().empty());
  shake(state, 0.01, 3);
  followers.see(state);
  CHECK_FALSE(followers.part.cells().empty());
}

TEST_CASE("an exposure that has been measured serves no other state", "[unit]") {
  TissueState state = wide_honeycomb();
  Followers followers;
  followers.see(state);
  followers.see(state);
  const std::vector<char> before = followers.part.exposed(state.tissue, state.view());
  for (int seed = 1; seed < 4; ++seed) {
    followers.part.exposed(state.tissue, state.view());
    shake(state, 0.02, seed);  // between the look at the exposure and that at the wound
    followers.see(state);
    const Exposure whole = exposed_vertices(state.tissue, state.view(), default_membrane());
    for (const int v : followers.part.wound()->boundary) CHECK(whole.exposed[v]);
  }
  CHECK(followers.part.exposed(state.tissue, state.view()) != before);
}

TEST_CASE("a cell that jumps into the wound from afar is seen", "[unit]") {
  TissueState state = wide_honeycomb();
  Followers followers;
  followers.see(state);
  followers.see(state);
  const StateView view = state.view();
  int far = 0;
  for (int c = 0; c < state.tissue.cell_count(); ++c)
    if (view.x[state.tissue.first_vertex(c)] > view.x[state.tissue.first_vertex(far)]) far = c;
  CHECK(std::find(followers.part.cells().begin(), followers.part.cells().end(), far) == followers.part.cells().end());
  const double area = followers.part.wound()->area;
  move_cell(state, far, -view.x[state.tissue.first_vertex(far)], -view.y[state.tissue.first_vertex(far)]);
  followers.see(state);
  CHECK(followers.part.wound()->area < area - 0.5);
}

TEST_CASE("a part of the wound that goes on outside the region is counted", "[unit]") {
  // A corridor of three cells. Then the cell at its end moves into it, and four beyond go away: what is left and a longer one.
  TissueState state = tissue_of(honeycomb({.rings = 8, .removed = [](Point p) { return std::abs(p.y) < 0.1 && std::abs(p.x) < 1.2; }}));
  Followers followers;
  followers.see(state);
  followers.see(state);
  CHECK_FALSE(followers.part.cells().empty());
  const TissueState before = state;
  for (int c = 0; c < state.tissue.cell_count(); ++c) {
    double x = 0.0, y = 0.0;
    for (int v = state.tissue.first_vertex(c); v < state.tissue.end_vertex(c); ++v) x += before.view().x[v], y += before.view().y[v];
    const double centre_x = x / state.tissue.vertex_count(c), centre_y = y / state.tissue.vertex_count(c);
    if (std::hypot(centre_x - 2.3, centre_y) < 0.1) move_cell(state, c, -1.7, 0.0);
    if (std::abs(centre_y) < 0.1 && centre_x > 3.0 && centre_x < 7.0) move_cell(state, c, 30.0, 0.0);
  }
  followers.see(state);
  CHECK(followers.whole.wound()->parts == 2);
  CHECK(followers.whole.wound()->area < 0.7 * followers.whole.wound()->area_of_parts);
}

TEST_CASE("coarse cells are seen from the cells around the wound, too", "[unit]") {
  for (const int points_per_side : {1, 2, 10}) {
    const TissueState fine =
        tissue_of(honeycomb({.rings = 5, .gap = 0.6 / points_per_side, .points_per_side = points_per_side, .removed = [](Point p) { return std::hypot(p.x, p.y) < 1.2; }}));
    const double segment = 0.6 / points_per_side;
    Membrane membrane = default_membrane();
    membrane.contact_distance = segment;
    WoundNeighbourhood part(membrane);
    TissueState state = fine;
    for (int k = 0; k < 4; ++k) {
      part.update(state.tissue, state.view());
      shake(state, 0.01 * segment, k + 1);
      CAPTURE(points_per_side, k);
      CHECK(part.cells().empty() == (k == 0));
    }
  }
}

TEST_CASE("the whole tissue decides whether a lost wound has closed or opened to the outside", "[unit]") {
  const TissueState ring =
      tissue_of(sector_ring({.cells = 8, .inner = [](double) { return 0.6; }, .outer = [](double) { return 1.6; }}));
  Followers closing{.tolerance = 1e-7};  // sides of neighbours are parallel
  TissueState state = ring;
  for (int step = 0; step < 7; ++step) {
    closing.see(state);
    for (int cell = 0; cell < 8; ++cell) {  // all inwards
      const int v = state.tissue.first_vertex(cell);
      const double x = ring.view().x[v], y = ring.view().y[v], r = std::hypot(x, y);
      move_cell(state, cell, -0.1 * x / r, -0.1 * y / r);
    }
  }
  CHECK(closing.part.status() == WoundStatus::closed);
  Followers opening;
  state = ring;
  opening.see(state);
  opening.see(state);
  move_cell(state, 3, 20.0, 0.0);
  opening.see(state);
  CHECK(opening.part.status() == WoundStatus::open_to_outside);
}
