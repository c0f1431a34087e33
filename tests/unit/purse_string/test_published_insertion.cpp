#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "unit/purse_string/ring_fixture.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Two cells of twelve vertices, 0-11 about (-1.2, 0) and 12-23 about (1.2, 0), radius 1: they face each other at x = 0.
TissueState two_cells(const std::vector<int>& ring) {
  TissueState state;
  state.tissue = Tissue({12, 12}, std::vector<CellMaterial>(2), std::vector<double>(24, 0.5));
  state.values.assign(state.layout().size(), 0.5);
  for (int v = 0; v < 24; ++v) {
    const double angle = 2.0 * std::numbers::pi * (v % 12) / 12;
    state.mutable_view().x[v] = (v < 12 ? -1.2 : 1.2) + std::cos(angle);
    state.mutable_view().y[v] = std::sin(angle);
  }
  return create_purse_string(std::move(state), ring, ring_parameters(), contact_distance);
}

}  // namespace

TEST_CASE("between both its neighbours on the membrane", "[unit]") {
  CHECK(published_insertion(two_cells({4, 3, 1, 0, 18, 17}), 2) == 1);
  CHECK(published_insertion(two_cells({1, 0, 18, 17, 4, 3}), 2) == 5);   // over the seam
  CHECK(published_insertion(two_cells({3, 18, 17, 1, 12, 13}), 2) == 0); // even where they are no neighbours in the ring
}

TEST_CASE("beside its one neighbour, on the side where the next ring vertex of the same cell lies", "[unit]") {
  CHECK(published_insertion(two_cells({6, 5, 3, 18, 17, 16}), 4) == 1);   // both neighbours
  CHECK(published_insertion(two_cells({7, 6, 3, 18, 17, 16}), 4) == 1);   // 3, and 6 on the other side
  CHECK(published_insertion(two_cells({11, 3, 0, 18, 17, 16}), 4) != 0);  // 11 is more than a third of the cell away
}

TEST_CASE("by distance: between two near ring vertices that are neighbours in the ring", "[unit]") {
  // 0 faces 18; its neighbours 1 and 11 are not in the ring.
  CHECK(published_insertion(two_cells({3, 2, 19, 17, 16, 15}), 0) == 2);
  CHECK(published_insertion(two_cells({19, 18, 5, 6, 2, 17}), 0) == 5);  // 18 and 19 follow each other: 19 and 17, over the seam
  // Two ring vertices that follow each other on one membrane leave no room, and the third is no neighbour of either.
  CHECK_FALSE(published_insertion(two_cells({19, 18, 6, 7, 8, 5}), 0).has_value());
}

TEST_CASE("a ring that encloses nothing takes no vertex", "[unit]") {
  TissueState state = two_cells({3, 2, 1});
  state = yield_tethers(std::move(state), {0});
  CHECK_FALSE(published_insertion(state, 4).has_value());
}
