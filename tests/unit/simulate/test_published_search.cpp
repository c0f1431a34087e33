#include <catch2/catch.hpp>

#include <algorithm>

#include "io/byte_archive.hpp"
#include "simulate/published_search.hpp"
#include "support/wound_tissues.hpp"
#include "suture/measure/wound.hpp"
#include "suture/physics/purse_string_operations.hpp"

using namespace suture;
using namespace suture::test;

namespace {

constexpr int fill_interval = 3;

/// A round wound whose string misses every fourth vertex of the edge.
TissueState wound_with_gaps() {
  TissueState state = tissue_of(sector_ring({.cells = 8,
                                             .inner = [](double) { return 1.0; },
                                             .outer = [](double) { return 2.0; },
                                             .gap = 0.02,
                                             .inner_points = 12}));
  std::vector<int> ring = find_wound(state.tissue, state.view(), default_membrane())->boundary;
  for (std::size_t k = ring.size(); k-- > 0;)
    if (k % 4 == 2) ring.erase(ring.begin() + static_cast<long>(k));
  PurseStringParameters parameters;
  return create_purse_string(std::move(state), ring, parameters, default_membrane().contact_distance);
}

}  // namespace

TEST_CASE("vertices are looked for at every third step and offered to the ring after every one", "[unit]") {
  TissueState state = wound_with_gaps();
  PublishedSearch search(default_membrane(), fill_interval, 1);
  const int before = state.purse_string.size();
  CHECK(search.step(0.1, state, state.view()));
  CHECK_FALSE(search.step(0.1, state, state.view()));  // the same step again
  CHECK_FALSE(search.offers_untethered(state.purse_string));
  CHECK(search.step(0.2, state, state.view()));
  CHECK(search.step(0.3, state, state.view()));
  REQUIRE(search.offers_untethered(state.purse_string));

  std::vector<EventRecord> log;
  CHECK(search.capture(state, {CaptureLaw::split}, log));
  CHECK(state.purse_string.size() == before + static_cast<int>(log.size()));
  CHECK(log.size() >= static_cast<std::size_t>(before) / 4);
  CHECK(std::is_sorted(log.begin(), log.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; }));

  // A tether that breaks is made anew after the next step, without a new look at the wound.
  const int broken = state.purse_string.vertex[5];
  state = yield_tethers(std::move(state), {5}, GapLaw::first);
  CHECK(search.step(0.4, state, state.view()));
  log.clear();
  CHECK(search.capture(state, {CaptureLaw::slip}, log));
  CHECK(std::any_of(log.begin(), log.end(), [&](const EventRecord& e) { return e.vertex == broken && e.kind == EventKind::capture; }));
}

TEST_CASE("a search that is saved and read goes on alike", "[unit]") {
  TissueState state = wound_with_gaps();
  PublishedSearch search(default_membrane(), fill_interval, 1);
  for (const double t : {0.1, 0.2, 0.3, 0.4}) search.step(t, state, state.view());
  ByteWriter saved;
  search.fields(saved);
  PublishedSearch other(default_membrane(), fill_interval, 1);
  ByteReader reader(saved.bytes());
  other.fields(reader);
  reader.expect_end();
  for (const double t : {0.5, 0.6}) search.step(t, state, state.view()), other.step(t, state, state.view());
  ByteWriter a, b;
  search.fields(a);
  other.fields(b);
  CHECK(a.bytes() == b.bytes());
  std::vector<EventRecord> log, other_log;
  TissueState copy = state;
  search.capture(state, {CaptureLaw::slip}, log);
  other.capture(copy, {CaptureLaw::slip}, other_log);
  CHECK(log == other_log);
  CHECK(state.values == copy.values);
}

TEST_CASE("offers can be rarer than steps", "[unit]") {
  const TissueState state = wound_with_gaps();
  PublishedSearch search(default_membrane(), 1, 4);
  for (int step = 1; step <= 12; ++step) {
    search.step(0.1 * step, state, state.view());
    CHECK(search.offers_untethered(state.purse_string) == (step % 4 == 0));
  }
}
