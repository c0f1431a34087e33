// The windows of the contact list against a count of every vertex and segment.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "neighbors/contact_list.hpp"
#include "ode/padded_tissue.hpp"
#include "support/random_tissue.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Positions in place, lengths and segments computed.
void load(PaddedTissue& padded, const TissueState& state) {
  kernels::best().shell_gradient(padded.shell, {state.view().x.data(), state.view().y.data()});
}

double distance_to_segment(const TissueState& state, int vertex, int segment) {
  const StateView v = state.view();
  const int next = state.tissue.next(segment);
  const double ex = v.x[next] - v.x[segment], ey = v.y[next] - v.y[segment];
  const double dx = v.x[vertex] - v.x[segment], dy = v.y[vertex] - v.y[segment];
  const double t = std::min(std::max((dx * ex + dy * ey) / (ex * ex + ey * ey), 0.0), 1.0);
  return std::hypot(dx - t * ex, dy - t * ey);
}

struct Tally {
  long near = 0, missed = 0, repeated = 0, listed = 0, own = 0, wide = 0, pairs = 0, pair_errors = 0, wrapped = 0, wrong_band = 0;
};

Tally tally(const TissueState& state, double reach, double self_reach, double skin) {
  PaddedTissue padded(state.tissue, SpringLaw::quadratic);
  load(padded, state);
  ContactList list(reach, self_reach, skin);
  list.build(padded.shell, kernels::best());
  const Tissue& tissue = state.tissue;
  std::map<std::pair<int, int>, int> covered;  // (vertex, segment)
  Tally result;
  for (const kernels::Window& w : list.entries(0).windows) {
    result.wide += w.segments < 1 || w.segments > 7;
    const int p = padded.vertex(w.p);
    CHECK(padded.slot(p) == w.p);
    double nearest = 1e300;
    for (int k = 0; k < w.segments; ++k) {
      const int segment = padded.vertex(w.q + k);
      result.own += tissue.cell_of(segment) == tissue.cell_of(p);
      result.wrapped += k > 0 && segment == tissue.first_vertex(tissue.cell_of(segment));
      ++covered[{p, segment}];
      nearest = std::min(nearest, distance_to_segment(state, p, segment));
    }
    const double width = skin / (ContactList::bands - 1), tolerance = 1e-12 * (reach + nearest);
    result.wrong_band += nearest < (w.band == 0 ? 0.0 : reach + (w.band - 1) * width - tolerance) || nearest >= reach + w.band * width + tolerance;
  }
  for (const auto& [key, count] : covered) result.listed += count, result.repeated += count > 1;
  for (int p = 0; p < tissue.vertex_count(); ++p)
    for (int s = 0; s < tissue.vertex_count(); ++s) {
      if (tissue.cell_of(p) == tissue.cell_of(s) || distance_to_segment(state, p, s) >= reach + skin) continue;
      ++result.near;
      result.missed += !covered.contains({p, s});
    }
  std::set<std::pair<int, int>> pairs;
  for (const kernels::SelfPair& pair : list.entries(0).self_pairs) {
    const int i = padded.vertex(pair.i), j = padded.vertex(pair.j);
    result.pair_errors += !pairs.insert(std::minmax(i, j)).second;
  }
  for (int i = 0; i < tissue.vertex_count(); ++i)
    for (int j = i + 1; j < tissue.vertex_count(); ++j) {
      const StateView v = state.view();
      const bool expected = self_reach > 0.0 && tissue.cell_of(i) == tissue.cell_of(j) && tissue.next(i) != j &&
                            tissue.next(j) != i && std::hypot(v.x[i] - v.x[j], v.y[i] - v.y[j]) < self_reach + skin;
      result.pairs += expected;
      result.pair_errors += expected != pairs.contains({i, j});
    }
  return result;
}

void check(const Tally& t) {
  CAPTURE(t.near, t.missed, t.repeated, t.listed, t.own, t.wide, t.pairs, t.pair_errors);
  CHECK(t.missed == 0);
  CHECK(t.repeated == 0);
  CHECK(t.own == 0);
  CHECK(t.wide == 0);
  CHECK(t.wrong_band == 0);
  CHECK(t.pair_errors == 0);
}

void check_some(const Tally& t) {
  CHECK(t.near > 0);
  check(t);
}

}  // namespace

TEST_CASE("every segment within reach of a vertex is in exactly one window", "[unit]") {
  long near = 0, wrapped = 0, pairs = 0;
  struct Size {
    int least, most;
  };
  for (const Size size : {Size{3, 3}, Size{3, 9}, Size{7, 8}, Size{15, 33}, Size{62, 70}})
    for (const double spacing : {1.2, 0.8, 0.45})  // apart, touching, crossing
      for (const double reach : {0.02, 0.2, 0.9}) {
        const TissueState state = random_tissue(
            11 * size.most + 3, {.minimum_vertices = size.least, .maximum_vertices = size.most, .spacing = spacing});
        CAPTURE(size.least, size.most, spacing, reach);
        const Tally t = tally(state, reach, 0.7 * reach, 0.1);
        check(t);
        near += t.near;
        wrapped += t.wrapped;
        pairs += t.pairs;
      }
  CHECK(near > 100000);
  CHECK(wrapped > 100);
  CHECK(pairs > 100);
}

TEST_CASE("a reach beyond the tissue lists everything once", "[unit]") {
  const TissueState state = random_tissue(5, {.minimum_vertices = 3, .maximum_vertices = 70});
  const Tally t = tally(state, 100.0, 0.0, 1.0);
  check(t);
  CHECK(t.near == t.listed);
  long expected = 0;
  for (int c = 0; c < state.tissue.cell_count(); ++c)
    expected +=
        static_cast<long>(state.tissue.vertex_count(c)) * (state.tissue.vertex_count() - state.tissue.vertex_count(c));
  CHECK(t.listed == expected);
}

TEST_CASE("cells on top of one another, in a row or far apart are all found", "[unit]") {
  TissueState stacked = random_tissue(6, {.rows = 1, .columns = 4, .minimum_vertices = 8, .maximum_vertices = 20});
  for (int c = 0; c < 4; ++c) {
    const double shift = stacked.view().x[stacked.tissue.first_vertex(c)];
    for (int v = stacked.tissue.first_vertex(c); v < stacked.tissue.end_vertex(c); ++v)
      stacked.mutable_view().x[v] -= shift;
  }
  check_some(tally(stacked, 0.1, 0.1, 0.05));
  check_some(tally(random_tissue(7, {.rows = 1, .columns = 12}), 0.2, 0.1, 0.1));
  check_some(tally(random_tissue(8, {.rows = 12, .columns = 1}), 0.2, 0.1, 0.1));
  TissueState scattered = random_tissue(9, {.rows = 4, .columns = 4});
  for (int v = scattered.tissue.first_vertex(15); v < scattered.tissue.end_vertex(15); ++v)
    scattered.mutable_view().x[v] += 1e6;
  check_some(tally(scattered, 0.2, 0.1, 0.1));
}

TEST_CASE("groups hold every window once, nearer bands first, in their order within a band", "[unit]") {
  const TissueState state = random_tissue(4, {.minimum_vertices = 3, .maximum_vertices = 20});
  PaddedTissue padded(state.tissue, SpringLaw::quadratic);
  load(padded, state);
  ContactList list(0.3, 0.0, 0.4);
  list.build(padded.shell, kernels::best());
  std::vector<kernels::Window> expected = list.entries(0).windows;
  std::stable_sort(expected.begin(), expected.end(), [](const auto& one, const auto& two) { return one.band < two.band; });
  const WindowGroups& groups = list.entries(0).groups;
  constexpr std::size_t size = kernels::WindowGroup::windows;
  REQUIRE(expected.size() > size);
  REQUIRE(expected.front().band < expected.back().band);
  REQUIRE(groups.windows() == expected.size());
  for (std::size_t k = 0; k < (expected.size() + size - 1) / size * size; ++k) {
    const kernels::WindowGroup& group = groups.data()[k / size];
    CAPTURE(k);
    for (int s = 0; s < kernels::window_segments; ++s)
      CHECK((group.segments[s] >> k % size & 1u) == (k < expected.size() && s < expected[k].segments));
    const kernels::WindowGroup::Slots slots = group.slots[k % size];
    if (k < expected.size()) CHECK((slots.p == expected[k].p && slots.q == expected[k].q));
    CHECK((slots.p >= 0 && slots.p < padded.slots() && slots.q >= 0 && slots.q < padded.slots()));  // the rest is loaded, too
  }
  for (int bands = 1; bands <= ContactList::bands; ++bands)
    CHECK(groups.windows(bands) == static_cast<std::size_t>(std::count_if(expected.begin(), expected.end(), [&](const auto& w) { return w.band < bands; })));
  CHECK(list.active(0) == groups.windows(1));
  list.age(0, 0.2);
  CHECK(list.active(0) == groups.windows());
}
