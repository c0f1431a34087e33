#include <catch2/catch.hpp>
#include <cmath>

#include "support/wound_tissues.hpp"
#include "suture/setup/acceptance.hpp"

using namespace suture;
using namespace suture::test;

namespace {

Config honeycomb_config() {
  Config config;
  config.contact.distance = default_membrane().contact_distance;
  config.contact.range = default_membrane().range;
  return config;
}

/// Hexagonal cells, some missing.
TissueState comb(std::function<bool(Point)> removed) {
  Honeycomb honeycomb_of;
  honeycomb_of.removed = std::move(removed);
  return tissue_of(honeycomb(honeycomb_of));
}

bool central(Point p) { return std::hypot(p.x, p.y) < 0.1; }

}  // namespace

TEST_CASE("A whole tissue is accepted, one with a hole is not", "[unit]") {
  const Config config = honeycomb_config();
  CHECK(judge_annealed(config, comb([](Point) { return false; })).accepted);
  const Acceptance holed = judge_annealed(config, comb(central));
  CHECK_FALSE(holed.accepted);
  CHECK(holed.largest_hole > 0.5);
  CHECK_THAT(holed.reason, Catch::Contains("wound.maximum_hole"));
}

TEST_CASE("A wound is judged by its area, other holes by theirs", "[unit]") {
  Config config = honeycomb_config();
  const TissueState state = comb(central);
  const Acceptance verdict = judge_wounded(config, state);
  REQUIRE(verdict.wound_area);
  CHECK_FALSE(verdict.accepted);
  CHECK_THAT(verdict.reason, Catch::Contains("wound.minimum_area"));
  config.wound.minimum_area = 0.9 * *verdict.wound_area;
  CHECK(judge_wounded(config, state).accepted);
  config.wound.maximum_area = 0.95 * *verdict.wound_area;
  CHECK_THAT(judge_wounded(config, state).reason, Catch::Contains("wound.maximum_area"));
}

TEST_CASE("A tissue in pieces or without a wound is refused", "[unit]") {
  Config config = honeycomb_config();
  config.wound.minimum_area = 0.0;
  const Acceptance torn = judge_annealed(config, comb([](Point p) { return std::abs(p.x) < 0.7; }));
  CHECK(torn.components == 2);
  CHECK_THAT(torn.reason, Catch::Contains("2 pieces"));
  CHECK_THAT(judge_wounded(config, comb([](Point) { return false; })).reason, Catch::Contains("no wound"));
}
