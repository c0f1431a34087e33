// The age of the contact list cannot be seen in a force.
#include <catch2/catch.hpp>

#include "support/integration.hpp"
#include "support/random_tissue.hpp"

using namespace suture;
using namespace suture::test;

TEST_CASE("a fresh and an aged contact list give the same forces", "[property]") {
  const double skin = 0.2;
  int aged_checks = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    TissueState state =
        random_tissue(seed, {.rows = 3, .columns = 3, .minimum_vertices = 5, .maximum_vertices = 35, .spacing = 0.85});
    const TissueOdeOptions options = ode_options(contact_law(0.2), SpringLaw::quadratic, true, skin);
    TissueOde aged(state.tissue, 0, options, {});
    std::vector<double> from_aged(state.values.size()), from_fresh(state.values.size());
    REQUIRE(aged.rate(0.0, state.values, from_aged) == Evaluation::ok);
    // At most skin/2 in all: the diagonal of a square of half-width 0.07 in each of the directions.
    for (const double amplitude : {0.03, 0.069}) {
      auto moved = state.values;
      const auto direction = random_direction(state, 10 * seed, amplitude);
      for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += direction[k];
      TissueOde fresh(state.tissue, 0, options, {});
      if (fresh.rate(0.0, moved, from_fresh) != Evaluation::ok) continue;
      REQUIRE(aged.rate(0.0, moved, from_aged) == Evaluation::ok);
      CHECK(aged.list_rebuilds() == 1);
      CAPTURE(seed, amplitude, largest(from_fresh));
      CHECK(largest_difference(from_aged, from_fresh) < 1e-12 * largest(from_fresh));
      ++aged_checks;
    }
  }
  CHECK(aged_checks >= 6);
}

TEST_CASE("one vertex that leaves its skin makes a new list", "[property]") {
  TissueState state = random_tissue(3);
  TissueOde ode(state.tissue, 0, ode_options(contact_law(0.2), SpringLaw::quadratic, true, 0.1), {});
  std::vector<double> out(state.values.size());
  REQUIRE(ode.rate(0.0, state.values, out) == Evaluation::ok);
  state.mutable_view().x[17] += 0.049;
  REQUIRE(ode.rate(0.0, state.values, out) == Evaluation::ok);
  CHECK(ode.list_rebuilds() == 1);
  state.mutable_view().x[17] += 0.002;
  REQUIRE(ode.rate(0.0, state.values, out) == Evaluation::ok);
  CHECK(ode.list_rebuilds() == 2);
}
