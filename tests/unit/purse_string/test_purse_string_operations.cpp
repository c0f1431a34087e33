#include <algorithm>
#include <catch2/catch.hpp>

#include "suture/errors.hpp"
#include "suture/physics/purse_string_chain.hpp"
#include "suture/physics/purse_string_operations.hpp"
#include "unit/purse_string/ring_fixture.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Cell vertices, rest lengths and the purse-string vertices common to both are the same bits.
void check_carried_over(const TissueState& before, const TissueState& after) {
  REQUIRE(static_cast<int>(after.values.size()) == after.layout().size());
  REQUIRE(after.purse_string.vertex.size() == after.purse_string.spring.size());
  REQUIRE(after.purse_string.vertex.size() == after.purse_string.mode.size());
  const StateView a = before.view(), b = after.view();
  const int V = before.tissue.vertex_count();
  for (int v = 0; v < V; ++v) {
    CHECK(a.x[v] == b.x[v]);
    CHECK(a.y[v] == b.y[v]);
    CHECK(a.rest_length[v] == b.rest_length[v]);
  }
  int common = 0;
  for (int j = 0; j < before.purse_string.size(); ++j)
    for (int k = 0; k < after.purse_string.size(); ++k)
      if (before.purse_string.vertex[j] == after.purse_string.vertex[k]) {
        ++common;
        CHECK(a.x[V + j] == b.x[V + k]);
        CHECK(a.y[V + j] == b.y[V + k]);
        CHECK(before.purse_string.mode[j] == after.purse_string.mode[k]);
      }
  CHECK(common == std::min(before.purse_string.size(), after.purse_string.size()));
  CHECK(after.time == before.time);
}

bool same(const ChainSpring& a, const ChainSpring& b) {
  return a.rest_length == b.rest_length && a.start_time == b.start_time && a.reference_length == b.reference_length;
}

double point_distance(const TissueState& state, int p, int q) {
  const StateView view = state.view();
  return std::hypot(view.x[p] - view.x[q], view.y[p] - view.y[q]);
}

/// A string that has been pulled about: moved vertices, one slipped tether, later time.
TissueState used_string(SpringLaw law = SpringLaw::quadratic) {
  TissueState state = with_string(ring_parameters(law));
  for (int j = 0; j < state.purse_string.size(); ++j) stretch_tether(state, j, 0.01 + 0.013 * j, 0.7 * j);
  state.purse_string.mode[5] = TetherMode::slipped;
  state.time += 0.8;
  return state;
}

double compliance(const PurseString& ring) {
  double sum = 0.0;
  for (const ChainSpring& s : ring.spring) sum += s.reference_length * s.reference_length;
  return sum;
}

}  // namespace

TEST_CASE("a purse string starts on top of its cell vertices, without tension", "[unit]") {
  const TissueState before = cells_around_a_hole();
  const std::vector<int> boundary{3, 4, 11, 12, 20, 27, 36};
  const PurseStringParameters parameters = ring_parameters(SpringLaw::relative);
  const TissueState after = create_purse_string(before, boundary, parameters, contact_distance);
  const PurseString& ring = after.purse_string;
  check_carried_over(before, after);
  CHECK(ring.vertex == boundary);
  CHECK(ring.shrink_rate == Approx(0.7 / 7));
  CHECK(ring.minimum_rest_length == Approx(0.05 * contact_distance));
  for (int j = 0; j < ring.size(); ++j) {
    CHECK(point_distance(after, after.layout().ring_point(j), boundary[j]) == 0.0);
    const double length = point_distance(before, boundary[j], boundary[(j + 1) % 7]);
    CHECK(ring.spring[j].rest_length == Approx(length));
    CHECK(ring.spring[j].reference_length == ring.spring[j].rest_length);
    CHECK(ring.spring[j].start_time == before.time);
    CHECK(ring.mode[j] == TetherMode::attached);
  }
}

TEST_CASE("a new string replaces the old one", "[unit]") {
  const TissueState before = used_string();
  const TissueState after = create_purse_string(before, {1, 9, 17, 25}, ring_parameters(), contact_distance);
  CHECK(after.purse_string.vertex == std::vector<int>{1, 9, 17, 25});
  for (int v = 0; v < before.tissue.vertex_count(); ++v)
    CHECK(after.view().rest_length[v] == before.view().rest_length[v]);
}

TEST_CASE("no purse string on an impossible boundary", "[unit]") {
  TissueState state = cells_around_a_hole();
  const PurseStringParameters parameters = ring_parameters();
  CHECK_THROWS_AS(create_purse_string(state, {1, 2}, parameters, contact_distance), NumericalError);
  CHECK_THROWS_AS(create_purse_string(state, {1, 2, 3, 2}, parameters, contact_distance), NumericalError);
  state.mutable_view().x[2] = state.view().x[1];
  state.mutable_view().y[2] = state.view().y[1];
  CHECK_THROWS_WITH(create_purse_string(state, {1, 2, 3}, parameters, contact_distance),
                    Catch::Contains("cell 0, vertex 1 and cell 0, vertex 2"));
}

TEST_CASE("a yield closes the chain over the gap", "[unit]") {
  const TissueState before = used_string();
  const PurseString& old = before.purse_string;
  for (const int j : {0, 6, old.size() - 1}) {
    const TissueState after = yield_tethers(before, {j});
    const PurseString& ring = after.purse_string;
    check_carried_over(before, after);
    const int size = ring.size();
    REQUIRE(size == old.size() - 1);
    CHECK(std::find(ring.vertex.begin(), ring.vertex.end(), old.vertex[j]) == ring.vertex.end());
    const int closing = (j - 1 + size) % size;
    CHECK(ring.rest_length(closing, after.time) ==
          Approx(point_distance(after, ring.vertex[closing], ring.vertex[(closing + 1) % size])).epsilon(1e-14));
    CHECK(ring.spring[closing].start_time == after.time);
    for (int k = 0; k < size; ++k)
      if (k != closing) CHECK(same(ring.spring[k], old.spring[k < j ? k : k + 1]));
    CHECK(compliance(ring) == Approx(compliance(old)).epsilon(1e-14));
    CHECK(ring.shrink_rate == old.shrink_rate);
  }
}

TEST_CASE("closing over a gap makes no tension if the string lies on its cell vertices", "[unit]") {
  const PurseStringParameters parameters = ring_parameters();
  TissueState before = with_string(parameters);
  before.time += 0.5;
  const TissueState after = yield_tethers(before, {4});
  const auto tension_before =
      PurseStringChain(before.tissue, before.purse_string, parameters).tensions(before.time, before.view());
  const auto tension_after =
      PurseStringChain(after.tissue, after.purse_string, parameters).tensions(after.time, after.view());
  REQUIRE(tension_before[3] > 0.01);
  CHECK(std::abs(tension_after[3]) < 1e-13);
  CHECK(tension_after[2] == tension_before[2]);
  CHECK(tension_after[4] == tension_before[5]);
}

TEST_CASE("yields in a batch are the same as neighbours closed once", "[unit]") {
  const TissueState before = used_string();
  const PurseString& old = before.purse_string;
  const int last = old.size() - 1;
  const TissueState after = yield_tethers(before, {last, 0, 5, 1, 5});  // over the seam, and one alone, named twice
  const PurseString& ring = after.purse_string;
  check_carried_over(before, after);
  REQUIRE(ring.size() == old.size() - 4);
  CHECK(ring.vertex.front() == old.vertex[2]);
  CHECK(ring.vertex.back() == old.vertex[last - 1]);
  CHECK(ring.spring.back().rest_length == Approx(point_distance(before, old.vertex[last - 1], old.vertex[2])));
  CHECK(compliance(ring) == Approx(compliance(old)).epsilon(1e-14));
  // One after the other: the same ring, for these lengths only the final neighbours matter.
  const PurseString single =
      yield_tethers(yield_tethers(yield_tethers(yield_tethers(before, {last}), {5}), {1}), {0}).purse_string;
  REQUIRE(single.vertex == ring.vertex);
  for (int k = 0; k < ring.size(); ++k) {
    CHECK(single.spring[k].rest_length == ring.spring[k].rest_length);
    CHECK(single.spring[k].reference_length == Approx(ring.spring[k].reference_length).epsilon(1e-14));
  }
}

TEST_CASE("the published gap is measured to the first vertex behind the first that yields", "[unit]") {
  const TissueState before = used_string();
  const std::vector<int>& old = before.purse_string.vertex;
  const auto closing_rest = [&](const std::vector<int>& yields, int closing, GapLaw law) {
    return yield_tethers(before, yields, law).purse_string.spring[closing].rest_length;
  };
  CHECK(closing_rest({4}, 3, GapLaw::first) == closing_rest({4}, 3, GapLaw::span));
  for (const std::vector<int>& yields : {std::vector<int>{4, 5}, {4, 5, 6, 7}}) {
    CHECK(closing_rest(yields, 3, GapLaw::first) == point_distance(before, old[3], old[5]));
    CHECK(closing_rest(yields, 3, GapLaw::span) == point_distance(before, old[3], old[yields.back() + 1]));
  }
  const int last = static_cast<int>(old.size()) - 1;
  CHECK(closing_rest({last, 0}, last - 2, GapLaw::first) == point_distance(before, old[last - 1], old[0]));
}

TEST_CASE("a ring of fewer than three vertices is removed", "[unit]") {
  const TissueState before =
      create_purse_string(cells_around_a_hole(), {1, 9, 17, 25}, ring_parameters(), contact_distance);
  CHECK(yield_tethers(before, {2}).purse_string.size() == 3);
  const TissueState gone = yield_tethers(before, {2, 0});
  CHECK(gone.purse_string.empty());
  CHECK(gone.purse_string.spring.empty());
  check_carried_over(before, gone);
  CHECK(captures(gone, {1, 9, 17}).empty());
}

TEST_CASE("a capture puts a vertex at its cell vertex, between its neighbours", "[unit]") {
  const TissueState before = used_string();
  const PurseString& old = before.purse_string;
  const int V = before.tissue.vertex_count();
  for (const CaptureLaw law : {CaptureLaw::split, CaptureLaw::tension_kept, CaptureLaw::tension_free, CaptureLaw::slip})
    for (const int after_index : {0, 4, old.size() - 1}) {
      const int vertex = 2;
      const TissueState after = capture_vertices(before, {{vertex, after_index}}, {law});
      const PurseString& ring = after.purse_string;
      check_carried_over(before, after);
      REQUIRE(ring.size() == old.size() + 1);
      CHECK(ring.vertex[after_index + 1] == vertex);
      CHECK(ring.mode[after_index + 1] == TetherMode::attached);
      CHECK(point_distance(after, V + after_index + 1, vertex) == 0.0);
      int unchanged = 0;
      for (int k = 0; k < ring.size(); ++k)
        if (k < old.size() && k <= after_index)
          unchanged += same(ring.spring[k], old.spring[k]);
        else if (k > after_index + 1)
          unchanged += same(ring.spring[k], old.spring[k - 1]);
      CHECK(unchanged == old.size() - 1);
    }
}

TEST_CASE("capture laws treat the split spring as defined", "[unit]") {
  const TissueState before = used_string();
  const PurseString& old = before.purse_string;
  const int V = before.tissue.vertex_count(), j = 4;
  const double t = before.time, lambda = old.rest_length(j, t), reference = old.spring[j].reference_length;
  REQUIRE(lambda < old.spring[j].rest_length);

  const PurseString split = capture_vertices(before, {{2, j}}, {CaptureLaw::split}).purse_string;
  for (const int k : {j, j + 1}) {
    CHECK(split.rest_length(k, t) == Approx(0.5 * lambda));
    CHECK(split.spring[k].start_time == t);
    CHECK(split.spring[k].reference_length == Approx(reference / std::sqrt(2.0)));
  }
  const TissueState free = capture_vertices(before, {{2, j}}, {CaptureLaw::tension_free});
  for (const int k : {j, j + 1})
    CHECK(free.purse_string.rest_length(k, t) == Approx(point_distance(free, V + k, V + k + 1)));

  const PurseString slip = capture_vertices(before, {{2, j}}, {CaptureLaw::slip}).purse_string;
  CHECK(same(slip.spring[j], old.spring[j]));
  CHECK(slip.rest_length(j + 1, t) == Approx(0.5 * old.rest_length(j + 1, t)));
  CHECK(slip.rest_length(j + 2, t) == Approx(0.5 * old.rest_length(j + 1, t)));
  // Behind the last vertex the spring after the successor is the ring's first.
  const int last = old.size() - 1;
  const PurseString seam = capture_vertices(before, {{2, last}}, {CaptureLaw::slip}).purse_string;
  CHECK(seam.rest_length(0, t) == Approx(0.5 * old.rest_length(0, t)));
  CHECK(same(seam.spring[last], old.spring[last]));
}

TEST_CASE("several captures in one spring share it, in order", "[unit]") {
  const TissueState before = used_string();
  const PurseString& old = before.purse_string;
  const double t = before.time;
  const TissueState after = capture_vertices(before, {{10, 7}, {2, 1}, {1, 1}, {4, 1}}, {CaptureLaw::split});
  const PurseString& ring = after.purse_string;
  check_carried_over(before, after);
  const std::vector<int> start(ring.vertex.begin(), ring.vertex.begin() + 6);
  CHECK(start == std::vector<int>{old.vertex[0], old.vertex[1], 2, 1, 4, old.vertex[2]});
  CHECK(ring.vertex[11] == 10);
  for (int k = 1; k <= 4; ++k) {
    CHECK(ring.rest_length(k, t) == Approx(old.rest_length(1, t) / 4));
    CHECK(ring.spring[k].reference_length == Approx(old.spring[1].reference_length / 2));
  }
  CHECK(compliance(ring) == Approx(compliance(old)).epsilon(1e-14));
  const PurseString slipped = capture_vertices(before, {{2, 1}, {1, 1}}, {CaptureLaw::slip}).purse_string;
  CHECK(slipped.rest_length(4, t) == Approx(old.rest_length(2, t) / 4));  // halved again and again
  CHECK(same(slipped.spring[1], old.spring[1]));
}

TEST_CASE("breaking and recapturing a tether leaves the chain as stiff as before", "[unit]") {
  TissueState state = with_string(ring_parameters());
  const PurseString old = state.purse_string;
  double worst = 0.0;
  for (int cycle = 0; cycle < 50; ++cycle) {
    state = yield_tethers(std::move(state), {4});
    state = capture_vertices(std::move(state), {{old.vertex[4], 3}}, {CaptureLaw::split});
    worst = std::max(worst, std::abs(compliance(state.purse_string) / compliance(old) - 1.0));
  }
  CHECK(state.purse_string.vertex == old.vertex);
  CHECK(worst < 1e-13);
}

TEST_CASE("operations with nothing to do do not touch the vector", "[unit]") {
  TissueState state = used_string();
  const double* data = state.values.data();
  state = yield_tethers(std::move(state), {});
  state = capture_vertices(std::move(state), {}, {CaptureLaw::split});
  CHECK(state.values.data() == data);
}
