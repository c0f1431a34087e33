#include <catch2/catch.hpp>

#include "unit/purse_string/ring_fixture.hpp"

using namespace suture;
using namespace suture::test;

namespace {

PurseString ring_of(std::vector<int> vertices) {
  PurseString ring;
  ring.vertex = std::move(vertices);
  ring.spring.resize(ring.vertex.size());
  ring.mode.resize(ring.vertex.size());
  return ring;
}

using Captures = std::vector<Capture>;

/// Points at given places, each a vertex of one big cell, with a string through `ring`.
TissueState points_with_string(const std::vector<std::pair<double, double>>& points, const std::vector<int>& ring) {
  TissueState state;
  const int count = static_cast<int>(points.size());
  state.tissue = Tissue({count}, {CellMaterial{}}, std::vector<double>(count, 0.1));
  state.values.assign(state.layout().size(), 0.1);
  for (int v = 0; v < count; ++v) {
    state.mutable_view().x[v] = points[v].first;
    state.mutable_view().y[v] = points[v].second;
  }
  return create_purse_string(std::move(state), ring, ring_parameters(), contact_distance);
}

}  // namespace

TEST_CASE("nothing to capture when every boundary vertex is tethered", "[unit]") {
  const PurseString ring = ring_of({10, 20, 30, 40});
  CHECK(captures(ring, {10, 20, 30, 40}).empty());
  CHECK(captures(ring, {30, 40, 10}).empty());
  CHECK(captures(ring, {}).empty());
}

TEST_CASE("a new vertex goes between the ring neighbours that enclose it", "[unit]") {
  const PurseString ring = ring_of({10, 20, 30, 40});
  CHECK(captures(ring, {10, 20, 25, 30, 40}) == Captures{{25, 1}});
  CHECK(captures(ring, {10, 11, 20, 25, 30, 40}) == Captures{{11, 0}, {25, 1}});
}

TEST_CASE("the boundary may start anywhere", "[unit]") {
  const PurseString ring = ring_of({10, 20, 30, 40});
  const std::vector<int> boundary{10, 11, 20, 30, 40, 41, 42};
  for (std::size_t shift = 0; shift < boundary.size(); ++shift) {
    std::vector<int> turned = boundary;
    std::rotate(turned.begin(), turned.begin() + static_cast<long>(shift), turned.end());
    Captures found = captures(ring, turned);
    std::stable_sort(found.begin(), found.end(), [](const Capture& a, const Capture& b) { return a.after < b.after; });
    CHECK(found == Captures{{11, 0}, {41, 3}, {42, 3}});
  }
}

TEST_CASE("consecutive captures keep the order of the boundary", "[unit]") {
  const PurseString ring = ring_of({10, 20, 30});
  CHECK(captures(ring, {14, 20, 30, 11, 12, 13, 10, 15}) == Captures{{11, 2}, {12, 2}, {13, 2}, {15, 0}, {14, 0}});
}

TEST_CASE("ring vertices that left the boundary are skipped over", "[unit]") {
  const PurseString ring = ring_of({10, 20, 30, 40, 50});
  CHECK(captures(ring, {10, 15, 40, 50}) == Captures{{15, 0}});
  CHECK(captures(ring, {15, 40}) == Captures{{15, 3}});
  CHECK(captures(ring, {1, 2, 3}).empty());
  CHECK(captures(ring_of({}), {1, 2, 3}).empty());
}

TEST_CASE("a vertex that the boundary passes twice is captured once", "[unit]") {
  CHECK(captures(ring_of({10, 20, 30}), {10, 15, 20, 15, 30}) == Captures{{15, 0}});
}

TEST_CASE("captures are inserted where they were placed", "[unit]") {
  TissueState state = with_string(ring_parameters());  // 0, 3, 6, ..., 39
  const std::vector<int> boundary{38, 39, 0, 1, 2, 3, 6, 9, 10, 12, 15, 18, 21, 24, 27, 30, 33, 36, 37};
  state = capture_vertices(std::move(state), captures(state.purse_string, boundary), {CaptureLaw::split});
  std::vector<int> turned = boundary;
  std::rotate(turned.begin(), turned.begin() + 2, turned.end());  // the ring starts at vertex 0
  CHECK(state.purse_string.vertex == turned);
  CHECK(captures(state.purse_string, boundary).empty());
}

TEST_CASE("beside a crevice the new vertex joins the side it lies on", "[unit]") {
  // Down one side of a crevice (1, 2), up the other (3, 4); 5 and 6 close the ring. 7 and 8 are at the lips.
  const std::vector<std::pair<double, double>> points{{0.0, 0.0}, {1.0, 0.0}, {1.0, -1.0}, {1.1, -1.0}, {1.1, 0.0},
                                                      {2.0, 0.0}, {1.0, 2.0}, {1.0, -0.3}, {1.1, -0.4}};
  const TissueState state = points_with_string(points, {0, 1, 2, 3, 4, 5, 6});
  const std::vector<int> boundary{0, 1, 7, 8, 4, 5, 6};  // 2 and 3 are hidden in the crevice
  CHECK(captures(state, boundary) == Captures{{7, 1}, {8, 3}});
  CHECK(captures(state.purse_string, boundary) == Captures{{7, 1}, {8, 1}});
  // Where nothing is hidden both agree.
  CHECK(captures(state, {0, 1, 7, 2, 3, 4, 5, 6}) == captures(state.purse_string, {0, 1, 7, 2, 3, 4, 5, 6}));
}

TEST_CASE("a misordered boundary never places a vertex past the next exposed ring vertex", "[unit]") {
  const std::vector<std::pair<double, double>> points{{0.0, 0.0}, {1.0, 0.0},  {1.0, 1.0},
                                                      {0.0, 1.0}, {-0.5, 0.5}, {0.1, 0.9}};
  const TissueState state = points_with_string(points, {0, 1, 2, 3, 4});
  CHECK(captures(state, {0, 5, 3, 1, 2, 4}) == Captures{{5, 0}});
}
