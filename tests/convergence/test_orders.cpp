// Observed orders of the methods on one smooth cell, and of what they report between steps.
#include <catch2/catch.hpp>
#include <cmath>

#include "support/convergence_order.hpp"
#include "support/integration.hpp"

using namespace suture;
using namespace suture::test;

namespace {

constexpr double end = 0.25;

struct SmoothProblem {
  TissueState state = wavy_cell(
      10, {.area_stiffness = 4.0, .membrane_stiffness = 1.0, .bending_stiffness = 0.02, .tau = 0.5, .memory = 0.2});
  TissueOde ode{state.tissue, 0, ode_options(contact_law(0.05, 0.1, false)), {}};
  std::vector<double> reference = integrate(ode, with_step(Method::rk4, 1.0 / 8192.0), 0.0, state.values, end);
};

/// RKC2 takes the steps it is told when its tolerance never binds.
IntegratorOptions fixed(Method method, double step) {
  IntegratorOptions options = with_tolerance(method, 0.05);
  options.time_step = options.initial_step = options.maximum_step = step;
  return options;
}

}  // namespace

TEST_CASE("Euler, RKC2 and RK4 converge at orders 1, 2 and 4", "[convergence]") {
  SmoothProblem problem;
  REQUIRE(largest_difference(problem.reference, problem.state.values) > 0.01);
  struct Row {
    Method method;
    double order, coarsest;
  };
  for (const Row& row :
       {Row{Method::euler, 1.0, 1.0 / 256}, Row{Method::rkc2, 2.0, 1.0 / 64}, Row{Method::rk4, 4.0, 1.0 / 64}}) {
    std::vector<double> errors;
    for (const double h : {row.coarsest, row.coarsest / 2, row.coarsest / 4, row.coarsest / 8}) {
      Statistics statistics;
      const auto y = integrate(problem.ode, fixed(row.method, h), 0.0, problem.state.values, end, &statistics);
      CHECK(statistics.steps == static_cast<int>(std::lround(end / h)));
      CHECK(statistics.error_test_failures == 0);
      errors.push_back(rms_difference(y, problem.reference));
    }
    CAPTURE(row.order, errors[0], errors[1], errors[2], errors[3]);
    CHECK(errors[0] > 1e-8);
    CHECK(median_order(errors) == Approx(row.order).margin(0.25));
  }
}

TEST_CASE("interpolation between steps keeps the accuracy of the method", "[convergence]") {
  SmoothProblem problem;
  struct Row {
    Method method;
    double order, coarsest;
  };
  for (const Row& row :
       {Row{Method::euler, 1.0, 1.0 / 256}, Row{Method::rkc2, 2.0, 1.0 / 64}, Row{Method::rk4, 4.0, 1.0 / 64}}) {
    std::vector<double> errors;
    for (const double h : {row.coarsest, row.coarsest / 2, row.coarsest / 4}) {
      const auto integrator = make_integrator(problem.ode, fixed(row.method, h), 0.0, problem.state.values);
      while (integrator->time() < 0.125) integrator->step(end);
      integrator->step(end);
      const double t = integrator->time() - 0.4 * integrator->last_step();
      std::vector<double> between(problem.state.values.size());
      integrator->interpolate(t, between);
      const auto exact = integrate(problem.ode, with_step(Method::rk4, 1.0 / 8192.0), 0.0, problem.state.values, t);
      errors.push_back(rms_difference(between, exact));
    }
    CAPTURE(row.order, errors[0], errors[1], errors[2]);
    CHECK(median_order(errors) == Approx(row.order).margin(0.4));
  }
}

TEST_CASE("CVODE's interpolant is as accurate as its steps, and meets both ends of a step", "[convergence]") {
  SmoothProblem problem;
  const double tolerance = 1e-7;
  const auto integrator =
      make_integrator(problem.ode, with_tolerance(Method::cvode, tolerance), 0.0, problem.state.values);
  std::vector<double> between(problem.state.values.size()), before(problem.state.values);
  int checked = 0;
  double worst = 0.0;
  while (integrator->time() < end) {
    integrator->step(end);
    integrator->interpolate(integrator->time(), between);
    CHECK(largest_difference(between, integrator->state()) < 1e-12);
    integrator->interpolate(integrator->time() - integrator->last_step(), between);
    CHECK(largest_difference(between, before) < 20.0 * tolerance);
    before.assign(integrator->state().begin(), integrator->state().end());
    if (integrator->statistics().steps % 5 != 0) continue;
    const double t = integrator->time() - 0.5 * integrator->last_step();
    integrator->interpolate(t, between);
    const auto exact = integrate(problem.ode, with_step(Method::rk4, 1.0 / 4096.0), 0.0, problem.state.values, t);
    worst = std::max(worst, rms_difference(between, exact));
    ++checked;
  }
  CHECK(checked >= 5);
  CHECK(worst > 0.0);
  CHECK(worst < 10.0 * tolerance);
}
