#include <catch2/catch.hpp>
#include <cmath>

#include "support/invariance.hpp"
#include "support/random_tissue.hpp"
#include "support/term_table.hpp"
#include "suture/physics/term_sum.hpp"

using namespace suture;
using namespace suture::test;

namespace {

double largest_norm(const std::vector<Point>& points) {
  double largest = 0.0;
  for (const Point& p : points) largest = std::max(largest, norm(p));
  return largest;
}

}  // namespace

TEST_CASE("energy and force do not depend on position, orientation, handedness or numbering", "[property]") {
  int checked = 0;
  for (const TermCase& row : term_table()) {
    if (!row.internal) continue;
    for (const std::uint64_t seed : {11, 12}) {
      const TissueState state = row.make_state(seed);
      const auto term = row.make_term(state);
      const double energy = term->energy(0.0, state.view());
      const std::vector<Point> gradient = point_gradient(*term, state);
      const double scale = largest_norm(gradient);
      REQUIRE(scale > 0.0);
      for (const Transformed& view : all_transformations(state)) {
        INFO(row.name << ", seed " << seed << ", " << view.name);
        const auto same_term = row.make_term(view.state);
        CHECK(std::abs(same_term->energy(0.0, view.state.view()) - energy) < 1e-11 * (1.0 + std::abs(energy)));
        const std::vector<Point> other = point_gradient(*same_term, view.state);
        double difference = 0.0;
        for (std::size_t i = 0; i < other.size(); ++i)
          difference = std::max(difference, norm(other[i] - view.turn(gradient[view.point_from[i]])));
        CHECK(difference < 1e-10 * scale);
        ++checked;
      }
    }
  }
  CHECK(checked > 0);
}

TEST_CASE("internal terms exert no net force and no net torque", "[property]") {
  int checked = 0;
  for (const TermCase& row : term_table()) {
    if (!row.internal) continue;
    for (const std::uint64_t seed : {21, 22, 23}) {
      const TissueState state = row.make_state(seed);
      const std::vector<Point> gradient = point_gradient(*row.make_term(state), state);
      Point force;
      double torque = 0.0, magnitude = 0.0;
      for (std::size_t i = 0; i < gradient.size(); ++i) {
        const Point position{state.view().x[i], state.view().y[i]};
        force = force + gradient[i];
        torque += cross(position, gradient[i]);
        magnitude += norm(gradient[i]) * (1.0 + norm(position));
      }
      INFO(row.name << ", seed " << seed);
      REQUIRE(magnitude > 0.0);
      CHECK(norm(force) < 1e-13 * magnitude);
      CHECK(std::abs(torque) < 1e-13 * magnitude);
      ++checked;
    }
  }
  CHECK(checked > 0);
}

TEST_CASE("a rigid translation costs nothing in the Hessian of an internal term", "[property]") {
  for (const TermCase& row : term_table()) {
    if (!row.internal) continue;
    const TissueState state = row.make_state(31);
    const int points = state.layout().points();
    const std::vector<double> vx(points, 0.6), vy(points, -0.8);
    std::vector<double> outx(points), outy(points);
    const auto term = row.make_term(state);
    add_hessian_product(*term, 0.0, state.view(), vx, vy, outx, outy);
    const double scale = assemble_hessian({term}, 0.0, state.view()).coeffs().abs().maxCoeff();
    INFO(row.name);
    for (int i = 0; i < points; ++i) {
      REQUIRE(std::abs(outx[i]) < 1e-12 * scale);
      REQUIRE(std::abs(outy[i]) < 1e-12 * scale);
    }
  }
}

TEST_CASE("terms add to what the buffer holds and leave the rest lengths alone", "[property]") {
  for (const TermCase& row : term_table()) {
    const TissueState state = row.make_state(41);
    const auto term = row.make_term(state);
    std::vector<double> buffer(state.layout().size(), 2.5);
    const MutableStateView view(state.layout(), buffer);
    term->add_gradient(0.0, state.view(), view);
    const std::vector<Point> gradient = point_gradient(*term, state);
    INFO(row.name);
    for (int i = 0; i < state.layout().points(); ++i) {
      REQUIRE(view.x[i] == Approx(2.5 + gradient[i].x).epsilon(1e-13));
      REQUIRE(view.y[i] == Approx(2.5 + gradient[i].y).epsilon(1e-13));
    }
    for (const double rest_length : view.rest_length) REQUIRE(rest_length == 2.5);
  }
}

TEST_CASE("a change of the unit of length changes energies not at all and forces inversely", "[property]") {
  const TissueState state = random_tissue(51), large = scaled(state, 7.0);
  for (const SpringLaw law : {SpringLaw::relative, SpringLaw::quadratic}) {
    Config config;
    config.membrane.law = law;
    const TermList terms = make_cell_terms(state.tissue, config), large_terms = make_cell_terms(large.tissue, config);
    REQUIRE(terms.size() == 5);
    for (std::size_t k = 0; k < terms.size(); ++k) {
      INFO(terms[k]->name());
      const double energy = terms[k]->energy(0.0, state.view());
      CHECK(std::abs(large_terms[k]->energy(0.0, large.view()) - energy) < 1e-12 * (1.0 + std::abs(energy)));
      const std::vector<Point> gradient = point_gradient(*terms[k], state),
                               other = point_gradient(*large_terms[k], large);
      for (std::size_t i = 0; i < gradient.size(); ++i)
        REQUIRE(norm(7.0 * other[i] - gradient[i]) < 1e-12 * (1.0 + largest_norm(gradient)));
    }
  }
}
