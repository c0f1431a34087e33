// Hand-computed values of the simple terms and what they refuse.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/invariance.hpp"
#include "suture/errors.hpp"
#include "suture/physics/area_elasticity.hpp"
#include "suture/physics/bending_elasticity.hpp"
#include "suture/physics/confinement.hpp"
#include "suture/physics/constant_load.hpp"
#include "suture/physics/membrane_elasticity.hpp"
#include "suture/physics/plates.hpp"
#include "suture/physics/term_sum.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// One 3 x 1 rectangle, with l0(0) = 0.5 and l0 = 2 for every segment.
TissueState rectangle(CellMaterial material = {}) {
  TissueState state{.tissue = Tissue({4}, {material}, std::vector<double>(4, 0.5))};
  state.values = {0, 3, 3, 0, 0, 0, 1, 1, 2, 2, 2, 2};
  return state;
}

}  // namespace

TEST_CASE("energies of a rectangle", "[unit]") {
  const TissueState state =
      rectangle({.rest_area = 2.0, .area_stiffness = 16.0, .membrane_stiffness = 3.0, .bending_stiffness = 0.1});
  const auto energy = [&](const EnergyTerm& term) { return term.energy(0.0, state.view()); };
  CHECK(energy(AreaElasticity(state.tissue)) == Approx(8.0 * 0.25));
  CHECK(energy(MembraneElasticity(state.tissue, SpringLaw::relative)) == Approx(1.5 * (4 * 0.25)));
  CHECK(energy(MembraneElasticity(state.tissue, SpringLaw::quadratic)) == Approx(1.5 * (4 * 4.0)));
  CHECK(energy(BendingElasticity(state.tissue)) == Approx(0.05 * 4 * std::numbers::pi * std::numbers::pi / 4));
}

TEST_CASE("both spring laws agree to first order while l0 = l0(0)", "[unit]") {
  const SpringResponse relative = spring_response(SpringLaw::relative, 2.0, 0.52, 0.5, 0.5);
  const SpringResponse quadratic = spring_response(SpringLaw::quadratic, 2.0, 0.52, 0.5, 0.5);
  CHECK(relative.energy == Approx(quadratic.energy));
  CHECK(relative.tension == Approx(2.0 * 0.02 / 0.25));
  CHECK(quadratic.tension == Approx(relative.tension));
  CHECK(spring_response(SpringLaw::quadratic, 2.0, 0.52, 0.4, 0.5).stiffness == quadratic.stiffness);
}

TEST_CASE("the turning angles of a simple cell add up to a full turn, concave corners included", "[unit]") {
  TissueState state{.tissue = Tissue({4}, {CellMaterial{.bending_stiffness = 2.0}}, std::vector<double>(4, 1.0))};
  state.values = {0, 2, 2, 1.5, 0, 0, 2, 0.5, 1, 1, 1, 1};  // a dart: one concave corner
  const double turn = std::numbers::pi;
  const double a = std::atan2(1.5, 0.5), b = std::atan2(0.5, 1.5);
  const double expected[] = {turn - b, turn / 2, turn / 2 + a, -(a - b)};
  CHECK(expected[0] + expected[1] + expected[2] + expected[3] == Approx(2 * turn));
  double energy = 0.0;
  for (const double angle : expected) energy += angle * angle;
  CHECK(BendingElasticity(state.tissue).energy(0.0, state.view()) == Approx(energy));
}

TEST_CASE("degenerate segments are failures that name cell and vertex", "[unit]") {
  TissueState state = rectangle();
  state.values[2] = 3.0, state.values[6] = 0.0;  // vertex 2 on vertex 1
  const MembraneElasticity membrane(state.tissue, SpringLaw::relative);
  const BendingElasticity bending(state.tissue);
  for (const EnergyTerm* term : {static_cast<const EnergyTerm*>(&membrane), static_cast<const EnergyTerm*>(&bending)}) {
    CHECK_THROWS_AS(term->energy(0.0, state.view()), NumericalError);
    CHECK_THROWS_WITH(point_gradient(*term, state),
                      Catch::Contains("cell 0, vertex 1: the segment to the next vertex has length zero"));
    std::vector<double> v(4, 1.0), outx(4), outy(4);
    CHECK_THROWS_AS(add_hessian_product(*term, 0.0, state.view(), v, v, outx, outy), NumericalError);
  }
  TissueState collapsed = rectangle();
  collapsed.values[8] = 0.0;
  CHECK_THROWS_WITH(membrane.energy(0.0, collapsed.view()), Catch::Contains("cell 0, vertex 0: the rest length"));
}

TEST_CASE("the wall pushes inwards, harder and harder, beyond its radius too", "[unit]") {
  TissueState state = rectangle();
  const Confinement wall(0.0, 0.5, 3.0, 1.0, 2.0, 4);
  const double r = std::hypot(3.0, 0.5);
  CHECK(r > 3.0);
  CHECK(wall.energy(0.0, state.view()) == Approx(2 * 2.0 * std::pow(1.0 - (3.0 - r), 2)));
  double last = 0.0;
  for (const double x : {2.5, 2.9, 3.1, 4.0, 9.0}) {
    state.values[1] = x, state.values[5] = 0.5;
    const std::vector<Point> gradient = point_gradient(wall, state);
    CHECK(gradient[1].x > last);
    CHECK(gradient[0].x == 0.0);
    last = gradient[1].x;
  }
  CHECK_THROWS_AS(Confinement(0, 0, 0.0, 1.0, 1.0, 4), InputError);
  CHECK_THROWS_AS(Confinement(0, 0, 1.0, 0.0, 1.0, 4), InputError);
  CHECK_THROWS_AS(Confinement(0, 0, 1.0, 1.0, -1.0, 4), InputError);
  state.values[0] = 0.0, state.values[4] = 0.5;
  CHECK_THROWS_AS(Confinement(0.0, 0.5, 1.0, 2.0, 1.0, 4).energy(0.0, state.view()), NumericalError);
}

TEST_CASE("the plates push towards each other, beyond their position too", "[unit]") {
  const TissueState state = rectangle();
  const Plates narrow({.center_y = 0.5, .gap = 0.6, .range = 0.2, .energy = 2.0}, 4);
  CHECK(narrow.energy(0.0, state.view()) == Approx(4 * 2.0 * 4.0));  // 0.2 beyond each plate: depth 2
  const std::vector<Point> gradient = point_gradient(narrow, state);
  CHECK(gradient[0].y == Approx(-2 * 2.0 * 2.0 / 0.2));
  CHECK(gradient[2].y == Approx(2 * 2.0 * 2.0 / 0.2));
  CHECK(gradient[2].x == 0.0);
  const Plates wide({.center_y = 0.5, .gap = 1.5, .range = 0.2, .energy = 2.0}, 4);
  CHECK(wide.energy(0.0, state.view()) == 0.0);
  CHECK_THROWS_AS(Plates({.gap = 0.0, .range = 1.0}, 4), InputError);
  CHECK_THROWS_AS(Plates({.gap = 1.0, .range = 0.0}, 4), InputError);
}

TEST_CASE("a load does work along its force", "[unit]") {
  const TissueState state = rectangle();
  const ConstantLoad load({1, 2, 0, 0}, {0, 0, 5, 0});
  CHECK(load.energy(0.0, state.view()) == -(2.0 * 3.0 + 5.0 * 1.0));
  CHECK(point_gradient(load, state)[1].x == -2.0);
  CHECK(point_gradient(load, state)[2].y == -5.0);
  CHECK_THROWS_AS(ConstantLoad({1.0}, {}), InputError);
}

TEST_CASE("energies are listed by name", "[unit]") {
  const TissueState state = rectangle();
  const auto load = std::make_shared<ConstantLoad>(std::vector<double>{1, 0, 0, 1}, std::vector<double>{0, 0, 1, 0});
  const auto area = std::make_shared<AreaElasticity>(state.tissue);
  const auto energies = energy_by_term({load, area, load}, 0.0, state.view());
  REQUIRE(energies.size() == 2);
  CHECK(energies[0].first == "load");
  CHECK(energies[0].second == Approx(-2.0));
  CHECK(energies[1].second == Approx(area->energy(0.0, state.view())));
  Config config;
  CHECK(make_cell_terms(state.tissue, config).size() == 5);
  config.contact.self_contact = false;
  CHECK(make_cell_terms(state.tissue, config).size() == 4);
}
