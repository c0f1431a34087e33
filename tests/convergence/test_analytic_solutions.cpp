// The integrators on problems whose solution is known in closed form, or from the assembled linear system alone.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>

#include "support/integration.hpp"
#include "suture/physics/term_sum.hpp"

using namespace suture;
using namespace suture::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct MethodCase {
  const char* name;
  IntegratorOptions options;
  double expected;  ///< error it must stay below, over some hundred steps of local error at most the tolerance each
};

std::vector<MethodCase> accurate_methods() {
  return {{"cvode", with_tolerance(Method::cvode, 1e-8), 3e-6},
          {"rkc2", with_tolerance(Method::rkc2, 1e-8), 5e-6},
          {"arkode", with_tolerance(Method::arkode, 1e-8), 5e-6},
          {"adams", with_tolerance(Method::adams, 1e-8), 5e-6},
          {"rk4", with_step(Method::rk4, 0.01), 1e-8}};
}

}  // namespace

TEST_CASE("rest lengths at fixed length relax exponentially towards the remembered mixture", "[convergence]") {
  const double tau = 0.7, memory = 0.3, end = 1.1;
  TissueState state = regular_cell(
      8, 1.0,
      {.area_stiffness = 0.0, .membrane_stiffness = 0.0, .bending_stiffness = 0.0, .tau = tau, .memory = memory});
  const double length = state.view().rest_length[0];
  std::vector<double> reference(8);
  for (int k = 0; k < 8; ++k) {
    state.mutable_view().rest_length[k] = length * (1.2 + 0.1 * k);
    reference[k] = length * (0.8 + 0.02 * k);
  }
  for (const MethodCase& method : accurate_methods()) {
    TissueOde ode(state.tissue, 0, ode_options(contact_law(0.1)), {}, reference);
    const auto y = integrate(ode, method.options, 0.0, state.values, end);
    CAPTURE(method.name);
    CHECK(largest_difference(std::span(y).first(16), std::span(state.values).first(16)) == 0.0);
    for (int k = 0; k < 8; ++k) {
      const double target = (1.0 - memory) * length + memory * reference[k];
      const double exact = target + (state.view().rest_length[k] - target) * std::exp(-end / tau);
      CHECK(std::abs(exact - state.view().rest_length[k]) > 0.1 * length);
      CHECK(std::abs(y[16 + k] - exact) < method.expected);
    }
  }
}

TEST_CASE("eigenmodes of a regular polygon decay at the rates of the assembled Hessian", "[convergence]") {
  const CellMaterial material{
      .area_stiffness = 5.0, .membrane_stiffness = 1.3, .bending_stiffness = 0.02, .tau = infinity};
  for (const SpringLaw law : {SpringLaw::quadratic, SpringLaw::relative}) {
    const TissueState rest = regular_cell(10, 0.5, material);
    Config config;
    config.membrane.law = law;
    config.contact = contact_law(0.05);
    const auto hessian = Eigen::MatrixXd(assemble_hessian(make_cell_terms(rest.tissue, config), 0.0, rest.view()));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(hessian);
    for (const int mode : {4, 9, 14, 19}) {
      const double decay = modes.eigenvalues()[mode], amplitude = 1e-5, end = 1.5 / decay;
      REQUIRE(decay > 1e-3);
      TissueState state = rest;
      for (int k = 0; k < 20; ++k) state.values[k] += amplitude * modes.eigenvectors()(k, mode);
      for (const Method method : {Method::cvode, Method::rkc2, Method::rk4}) {
        TissueOde ode(state.tissue, 0, ode_options(config.contact, law), {});
        IntegratorOptions options = with_tolerance(method, 3e-12);
        options.time_step = std::min(0.5 / modes.eigenvalues()[19], 0.02 / decay);
        const auto y = integrate(ode, options, 0.0, state.values, end);
        double projected = 0.0, rest_of_it = 0.0;
        for (int k = 0; k < 20; ++k) projected += (y[k] - rest.values[k]) * modes.eigenvectors()(k, mode);
        for (int k = 0; k < 20; ++k)
          rest_of_it =
              std::max(rest_of_it, std::abs(y[k] - rest.values[k] - projected * modes.eigenvectors()(k, mode)));
        CAPTURE(mode, decay, static_cast<int>(method), projected / amplitude);
        CHECK(-std::log(projected / amplitude) / end == Approx(decay).epsilon(2e-4));
        CHECK(rest_of_it < 1e-3 * amplitude);
      }
    }
  }
}

TEST_CASE("a plastic cell near equilibrium follows the exponential of its linear system", "[convergence]") {
  const double tau = 0.4, memory = 0.25;
  const TissueState rest = regular_cell(
      7, 0.5,
      {.area_stiffness = 5.0, .membrane_stiffness = 1.3, .bending_stiffness = 0.02, .tau = tau, .memory = memory});
  Config config;
  config.contact = contact_law(0.05);
  const int n = 7;
  const double side = rest.view().rest_length[0], spring = 1.3 / (side * side);
  // d/dt (r, l0) = J (r, l0) with the quadratic law: tension k (l - l0), rest-length rate -(l0 - (1 - xi) l - xi
  // l0_ref)/tau.
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  jacobian.topLeftCorner(2 * n, 2 * n) =
      -Eigen::MatrixXd(assemble_hessian(make_cell_terms(rest.tissue, config), 0.0, rest.view()));
  for (int s = 0; s < n; ++s) {
    const int next = (s + 1) % n;
    const double ux = (rest.values[next] - rest.values[s]) / side,
                 uy = (rest.values[n + next] - rest.values[n + s]) / side;
    for (const auto& [point, sign] : {std::pair{s, -1.0}, std::pair{next, 1.0}}) {
      jacobian(point, 2 * n + s) += spring * sign * ux;
      jacobian(n + point, 2 * n + s) += spring * sign * uy;
      jacobian(2 * n + s, point) += (1.0 - memory) / tau * sign * ux;
      jacobian(2 * n + s, n + point) += (1.0 - memory) / tau * sign * uy;
    }
    jacobian(2 * n + s, 2 * n + s) = -1.0 / tau;
  }
  Eigen::VectorXd change(3 * n);
  for (int k = 0; k < 3 * n; ++k) change[k] = 1e-6 * std::sin(1.0 + 2.3 * k);
  TissueState state = rest;
  for (int k = 0; k < 3 * n; ++k) state.values[k] += change[k];
  for (const double end : {0.05, 0.6}) {
    const Eigen::VectorXd exact = (end * jacobian).exp() * change;
    REQUIRE(exact.lpNorm<Eigen::Infinity>() > 1e-7);
    for (const Method method : {Method::cvode, Method::rkc2, Method::rk4}) {
      TissueOde ode(state.tissue, 0, ode_options(config.contact), {});
      IntegratorOptions options = with_tolerance(method, 1e-12);
      options.time_step = 5e-4;
      const auto y = integrate(ode, options, 0.0, state.values, end);
      double worst = 0.0;
      for (int k = 0; k < 3 * n; ++k) worst = std::max(worst, std::abs(y[k] - rest.values[k] - exact[k]));
      CAPTURE(end, static_cast<int>(method));
      CHECK(worst < 1e-4 * 1e-6 + 1e-10);
    }
  }
}

TEST_CASE("two apices in repulsive contact part exponentially to the contact distance", "[convergence]") {
  // Each apex meets the other cell, so the pair counts twice: d' = -4 u'(d) = (8 e/s)(1 - d/s).
  const double s = 0.2, energy = 0.5, start = 0.13, end = 0.02;
  const double exact = s - (s - start) * std::exp(-8.0 * energy * end / (s * s));
  REQUIRE(exact > start + 0.05);
  for (const MethodCase& method : accurate_methods()) {
    TissueState state = facing_triangles(start);
    TissueOde ode(state.tissue, 0, ode_options(contact_law(s)), {});
    IntegratorOptions options = method.options;
    options.time_step = 1e-4;
    const auto y = integrate(ode, options, 0.0, state.values, end);
    CAPTURE(method.name, exact);
    CHECK(std::abs(y[3] - y[0] - exact) < method.expected);
    CHECK(y[3] + y[0] == Approx(start).margin(1e-12));  // no net force
    for (const int still : {1, 2, 4, 5}) CHECK(y[still] == state.values[still]);
  }
}

TEST_CASE("two apices on the attractive branch fall towards each other exponentially", "[convergence]") {
  // Negative stiffness: with x = s(1 + l2) - d, x' = kappa x, kappa = 8 e l1/((l2 - l1) s^2), until d = s(1 + l1).
  const double s = 0.2, energy = 0.5, l1 = 0.1, l2 = 0.3, start = s * (1.0 + l2) - 0.01;
  const double kappa = 8.0 * energy * l1 / ((l2 - l1) * s * s), end = 1.0 / kappa;
  const double exact = s * (1.0 + l2) - 0.01 * std::exp(kappa * end);
  REQUIRE(exact > s * (1.0 + l1));
  for (const MethodCase& method : accurate_methods()) {
    TissueState state = facing_triangles(start);
    TissueOde ode(state.tissue, 0, ode_options(contact_law(s, l1)), {});
    IntegratorOptions options = method.options;
    options.time_step = 2e-4;
    const auto y = integrate(ode, options, 0.0, state.values, end);
    CAPTURE(method.name, exact, kappa);
    CHECK(std::abs(y[3] - y[0] - exact) < method.expected);
  }
}

TEST_CASE("elastic cells and cells that flow at once are both integrated", "[convergence]") {
  // tau -> 0: rest lengths follow the lengths at once, so the membrane carries no tension: as if it were absent.
  const CellMaterial material{
      .area_stiffness = 5.0, .membrane_stiffness = 1.0, .bending_stiffness = 0.02, .tau = infinity};
  const TissueState elastic = wavy_cell(12, material);
  TissueOde without_flow(elastic.tissue, 0, ode_options(contact_law(0.05)), {});
  const auto y = integrate(without_flow, with_tolerance(Method::cvode, 1e-7), 0.0, elastic.values, 0.5);
  CHECK(largest_difference(std::span(y).subspan(24), std::span(elastic.values).subspan(24)) == 0.0);
  CHECK(largest_difference(std::span(y).first(24), std::span(elastic.values).first(24)) > 1e-2);

  CellMaterial flowing = material, slack = material;
  flowing.tau = 1e-10;
  slack.membrane_stiffness = 0.0;
  TissueState relaxed = elastic;
  for (int k = 0; k < 12; ++k) {
    const int next = elastic.tissue.next(k);
    relaxed.mutable_view().rest_length[k] =
        std::hypot(elastic.values[next] - elastic.values[k], elastic.values[12 + next] - elastic.values[12 + k]);
  }
  TissueOde fluid(elastic.tissue.with_materials({flowing}), 0, ode_options(contact_law(0.05)), {});
  TissueOde free(elastic.tissue.with_materials({slack}), 0, ode_options(contact_law(0.05)), {});
  const auto flowed = integrate(fluid, with_tolerance(Method::cvode, 1e-7), 0.0, relaxed.values, 0.5);
  const auto expected = integrate(free, with_tolerance(Method::rkc2, 1e-8), 0.0, relaxed.values, 0.5);
  CHECK(largest_difference(std::span(flowed).first(24), std::span(relaxed.values).first(24)) > 1e-3);
  CHECK(largest_difference(std::span(flowed).first(24), std::span(expected).first(24)) < 3e-6);
}
