// The contact list against a plain search that looks at every vertex and segment: the same windows in the same order.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <optional>

#include "neighbors/contact_list.hpp"
#include "ode/padded_tissue.hpp"
#include "support/random_tissue.hpp"
#include "support/runnable_tables.hpp"

using namespace suture;
using namespace suture::test;

namespace {

struct Reach {
  double contact, own, skin;
};
using Key = std::array<int, 4>;  // vertex's and first segment's slot, segments, band

constexpr double rounding = 1e-11;

double squared_distance(const kernels::Shell& s, int p, int q) {
  const double ex = s.x[q + 1] - s.x[q], ey = s.y[q + 1] - s.y[q], dx = s.x[p] - s.x[q], dy = s.y[p] - s.y[q];
  const double t = std::clamp((dx * ex + dy * ey) / (ex * ex + ey * ey), 0.0, 1.0);
  return (dx - t * ex) * (dx - t * ex) + (dy - t * ey) * (dy - t * ey);
}

/// The windows of a vertex over a cell's segments; nothing if rounding decides where one is cut or which band it is in.
std::optional<std::vector<Key>> windows(const kernels::Shell& s, const Reach& reach, int p, int cell) {
  const int n = s.count[cell], first = s.base[cell] + 1;
  std::vector<double> d2;
  std::vector<int> near;
  for (int k = 0; k < n; ++k) {
    d2.push_back(squared_distance(s, p, first + k));
    for (int band = 0; band < ContactList::bands; ++band) {
      const double edge = reach.contact + band * reach.skin / (ContactList::bands - 1);
      if (std::abs(d2[k] - edge * edge) < rounding) return {};
    }
    if (d2[k] < (reach.contact + reach.skin) * (reach.contact + reach.skin)) near.push_back(k);
  }
  if (!near.empty() && near.front() == 0 && near.back() == n - 1 && static_cast<int>(near.size()) < n) {
    auto lead = near.end() - 1;
    while (lead[-1] == lead[0] - 1) --lead;
    std::rotate(near.begin(), lead, near.end());
  }
  const auto distance2 = [&](int k) { return d2[near[k]]; };
  std::vector<Key> result;
  for (int begin = 0, end, count = static_cast<int>(near.size()); begin < count; begin = end) {
    for (end = begin + 1; end < count && near[end] == (near[end - 1] + 1) % n;) ++end;
    int nearest = begin, ties = 0;
    for (int k = begin; k < end; ++k) nearest = distance2(k) < distance2(nearest) ? k : nearest;
    for (int k = begin; k < end; ++k) ties += distance2(k) < distance2(nearest) + rounding;
    if (ties > 1) return {};
    for (int from = nearest - 1 - (nearest - 1 - begin + 3) / 3 * 3; from < end; from += 3) {
      const int a = std::max(from, begin), b = std::min(from + 3, end);
      if (a >= b) continue;
      double closest = distance2(a);
      for (int k = a; k < b; ++k) closest = std::min(closest, distance2(k));
      int band = 0;
      while (band < ContactList::bands - 1 && std::sqrt(closest) >= reach.contact + band * reach.skin / (ContactList::bands - 1)) ++band;
      result.push_back({p, first + near[a], b - a, band});
    }
  }
  return result;
}

struct Compared {
  long windows = 0, undecided = 0, pairs = 0;
};

/// Requires that `list` is what a plain search finds.
void compare(const kernels::Shell& s, const Reach& reach, const ContactList::Entries& list, Compared& compared) {
  std::size_t at = 0, pair = 0;
  const auto take = [&](int p, int cell) {  // the list's next windows, if they are of this vertex and cell
    std::vector<Key> found;
    for (; at < list.windows.size(); ++at) {
      const kernels::Window& w = list.windows[at];
      if (w.p != p || w.q <= s.base[cell] || w.q > s.base[cell] + s.count[cell]) break;
      found.push_back({w.p, w.q, w.segments, w.band});
    }
    return found;
  };
  for (int c = 0; c < s.cells; ++c) {
    for (int p = s.base[c] + 1; p <= s.base[c] + s.count[c]; ++p)
      for (int other = 0; other < s.cells; ++other) {
        if (other == c) continue;
        const std::vector<Key> found = take(p, other);
        const auto expected = windows(s, reach, p, other);
        if (expected) REQUIRE(found == *expected);
        compared.windows += static_cast<long>(found.size());
        compared.undecided += !expected;
      }
    const int b = s.base[c] + 1, n = s.count[c];
    for (int i = 0; i < n; ++i)
      for (int j = i + 2; j < n; ++j) {
        const double dx = s.x[b + i] - s.x[b + j], dy = s.y[b + i] - s.y[b + j], own = reach.own + reach.skin;
        if ((i == 0 && j == n - 1) || dx * dx + dy * dy >= own * own) continue;
        REQUIRE(pair < list.self_pairs.size());
        REQUIRE((list.self_pairs[pair].i == b + i && list.self_pairs[pair].j == b + j));
        ++pair;
      }
  }
  REQUIRE(at == list.windows.size());
  REQUIRE(pair == list.self_pairs.size());
  compared.pairs += static_cast<long>(pair);
}

}  // namespace

TEST_CASE("the contact list is what a plain search finds, in its order", "[property]") {
  struct Size {
    int rows, columns, least, most;
  };
  Compared compared;
  for (const Size size : {Size{3, 3, 3, 12}, Size{3, 4, 15, 33}, Size{2, 2, 60, 140}, Size{9, 9, 5, 9}})
    for (const double spacing : {0.9, 0.5})
      for (const Reach reach : {Reach{0.05, 0.03, 0.02}, Reach{0.2, 0.15, 0.1}, Reach{0.6, 0.9, 0.2}})
        for (const kernels::Table* table : runnable_tables()) {
          const TissueState state = random_tissue(size.most, {.rows = size.rows, .columns = size.columns, .minimum_vertices = size.least,
                                                              .maximum_vertices = size.most, .spacing = spacing});
          PaddedTissue padded(state.tissue, SpringLaw::quadratic);
          table->shell_gradient(padded.shell, {state.view().x.data(), state.view().y.data()});
          ContactList list(reach.contact, reach.own, reach.skin);
          list.build(padded.shell, *table);
          CAPTURE(table->name, size.most, spacing, reach.contact);
          compare(padded.shell, reach, list.entries(0), compared);
        }
  CHECK(compared.windows > 100000);
  CHECK(compared.pairs > 10000);
  CHECK(5 * compared.undecided < compared.windows);
}
