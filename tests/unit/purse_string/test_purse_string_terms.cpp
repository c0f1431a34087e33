#include <catch2/catch.hpp>
#include <limits>

#include "suture/errors.hpp"
#include "suture/physics/purse_string_chain.hpp"
#include "suture/physics/purse_string_tethers.hpp"
#include "unit/purse_string/ring_fixture.hpp"

using namespace suture;
using namespace suture::test;

namespace {

const double k_p = 4.0, l_y = 0.26, h = 0.13;

TetherResponse response(TetherLaw law, double l, TetherMode mode = TetherMode::attached) {
  return tether_response(law, mode, k_p, l_y, l);
}

}  // namespace

TEST_CASE("tether forces are those of the printed laws", "[unit]") {
  for (const TetherLaw law :
       {TetherLaw::saturating_force, TetherLaw::saturating_energy, TetherLaw::published, TetherLaw::ramp})
    CHECK(response(law, 0.4 * h).force == Approx(k_p * 0.4 * h));
  CHECK(response(TetherLaw::saturating_force, 1.7 * h).force == Approx(k_p * h));
  CHECK(response(TetherLaw::saturating_energy, 1.7 * h, TetherMode::slipped).force == 0.0);
  CHECK(response(TetherLaw::saturating_energy, 0.4 * h, TetherMode::slipped).force == 0.0);
  CHECK(response(TetherLaw::saturating_energy, 1.7 * h).force == Approx(k_p * 1.7 * h));  // until the event
  CHECK(response(TetherLaw::published, 1.7 * h).force == Approx(k_p * h));
  CHECK(response(TetherLaw::published, -1.7 * h).force == Approx(-k_p * 1.7 * h));
  CHECK(response(TetherLaw::ramp, 1.5 * h).force == Approx(0.5 * k_p * h));
  CHECK(response(TetherLaw::ramp, l_y).force == 0.0);
  CHECK(response(TetherLaw::ramp, 3.0 * l_y).force == 0.0);
}

TEST_CASE("only saturating_energy reads the mode", "[unit]") {
  for (const TetherLaw law : {TetherLaw::saturating_force, TetherLaw::published, TetherLaw::ramp})
    for (const double l : {0.3 * h, 1.2 * h})
      CHECK(response(law, l).force == response(law, l, TetherMode::slipped).force);
}

TEST_CASE("tether energies are continuous where the law is, and at a slip", "[unit]") {
  const double e = 1e-9;
  for (const TetherLaw law : {TetherLaw::saturating_force, TetherLaw::published, TetherLaw::ramp})
    for (const double l : {h, l_y}) {
      CHECK(response(law, l + e).energy - response(law, l - e).energy ==
            Approx(2 * e * response(law, l).force).margin(1e-15));
      CHECK(response(law, l + e).force == Approx(response(law, l - e).force).margin(20 * e));
    }
  CHECK(response(TetherLaw::saturating_energy, h).energy ==
        Approx(response(TetherLaw::saturating_energy, h, TetherMode::slipped).energy).epsilon(1e-14));
}

TEST_CASE("a chain spring pulls as its law says", "[unit]") {
  for (const SpringLaw law : {SpringLaw::relative, SpringLaw::quadratic}) {
    const PurseStringParameters parameters = ring_parameters(law);
    const TissueState state = with_string(parameters);
    const PurseString& ring = state.purse_string;
    const PurseStringChain chain(state.tissue, ring, parameters);
    CHECK(chain.energy(state.time, state.view()) == 0.0);  // created without tension
    const double later = state.time + 0.3;
    const std::vector<double> tension = chain.tensions(later, state.view());
    double energy = 0.0;
    for (int j = 0; j < ring.size(); ++j) {
      const double length = ring.spring[j].rest_length, shrunk = length - 0.3 * 0.7 / ring.size();
      REQUIRE(ring.rest_length(j, later) == Approx(shrunk));
      const double strain = law == SpringLaw::relative ? length / shrunk - 1.0 : (length - shrunk) / length;
      energy += 0.5 * 1.3 * strain * strain;
      CHECK(tension[j] == Approx(1.3 * strain / (law == SpringLaw::relative ? shrunk : length)));
    }
    CHECK(chain.energy(later, state.view()) == Approx(energy));
  }
}

namespace {

struct BlockCheck final : HessianSink {
  void add_block(int, int, const Block& block) override {
    ++blocks;
    for (const double entry : block) finite = finite && std::isfinite(entry);
  }
  void add_rank_one(int, double, std::span<const double>, std::span<const double>) override {}
  int blocks = 0;
  bool finite = true;
};

}  // namespace

TEST_CASE("a quadratic spring without rest length and springs of vanishing length stay finite", "[unit]") {
  const PurseStringParameters parameters = ring_parameters();
  TissueState state = with_string(parameters);
  const int V = state.tissue.vertex_count();
  const PurseStringChain chain(state.tissue, state.purse_string, parameters);
  const double end = 1e6;  // every rest length is zero by then
  REQUIRE(state.purse_string.rest_length(0, end) == 0.0);
  for (const double t : {state.time, end})
    for (const double length : {1e-12, 1e-200, 0.0}) {
      MutableStateView view = state.mutable_view();
      view.x[V + 1] = view.x[V] = 0.0;
      view.y[V + 1] = view.y[V] = 0.0;
      view.x[V + 1] += length;
      std::vector<double> gradient(state.values.size(), 0.0);
      chain.add_gradient(t, state.view(), MutableStateView(state.layout(), gradient));
      for (const double g : gradient) CHECK(std::isfinite(g));
      CHECK(std::isfinite(chain.energy(t, state.view())));
      BlockCheck blocks;
      chain.add_hessian(t, state.view(), blocks);
      CHECK(blocks.finite);
      CHECK(blocks.blocks == 3 * state.purse_string.size());
    }
}

TEST_CASE("an unstretched tether exerts no force and has a finite Hessian", "[unit]") {
  const TissueState state = with_string(ring_parameters());
  const PurseStringTethers tethers(state.tissue, state.purse_string, ring_parameters(), contact_distance);
  for (const double f : tethers.forces(state.view())) CHECK(f == 0.0);
  BlockCheck blocks;
  tethers.add_hessian(state.time, state.view(), blocks);
  CHECK(blocks.finite);
  CHECK(blocks.blocks == 3 * state.purse_string.size());
}

TEST_CASE("yield length is given in contact distances", "[unit]") {
  TissueState state = with_string(ring_parameters());
  PurseStringParameters parameters = ring_parameters();
  parameters.tether_law = TetherLaw::saturating_force;
  parameters.yield_length = 1.5;
  stretch_tether(state, 2, 1.0, 0.3);
  const PurseStringTethers tethers(state.tissue, state.purse_string, parameters, contact_distance);
  CHECK(tethers.forces(state.view())[2] == Approx(4.0 * 0.75 * contact_distance));
}

TEST_CASE("terms refuse impossible parameters", "[unit]") {
  PurseStringParameters parameters = ring_parameters(SpringLaw::relative);
  TissueState state = with_string(parameters);
  CHECK_NOTHROW(PurseStringChain(state.tissue, state.purse_string, parameters));
  state.purse_string.minimum_rest_length = 0.0;
  CHECK_THROWS_AS(PurseStringChain(state.tissue, state.purse_string, parameters), InputError);
  parameters.law = SpringLaw::quadratic;
  CHECK_NOTHROW(PurseStringChain(state.tissue, state.purse_string, parameters));
  state.purse_string.spring[3].reference_length = 0.0;
  CHECK_THROWS_AS(PurseStringChain(state.tissue, state.purse_string, parameters), InputError);
  CHECK_THROWS_AS(PurseStringTethers(state.tissue, state.purse_string, parameters, 0.0), InputError);
}
