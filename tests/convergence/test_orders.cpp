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

TEST_CASE("modified velocity Verlet converges at order 2 to the motion with mass, and that to the overdamped motion", "[convergence]") {
  SmoothProblem problem;
  const auto with_mass = [&](double mass, double h) {
    IntegratorOptions options = with_step(Method::verlet, h);
    options.vertex_mass = mass;
    return integrate(problem.ode, options, 0.0, problem.state.values, end);
  };
  const auto inertial = with_mass(1.0, 1.0 / 8192);
  std::vector<double> errors, inertia;
  for (const double h : {1.0 / 64, 1.0 / 128, 1.0 / 256, 1.0 / 512}) errors.push_back(rms_difference(with_mass(1.0, h), inertial));
  CAPTURE(errors[0], errors[1], errors[2], errors[3]);
  CHECK(errors[0] > 1e-8);
  CHECK(median_order(errors) == Approx(2.0).margin(0.25));
  // Small masses only: the inertial correction is of first order in m once m/b is short beside every decay time.
  for (const double mass : {4e-3, 2e-3, 1e-3}) inertia.push_back(rms_difference(with_mass(mass, 1.0 / 16384), problem.reference));
  CAPTURE(inertia[0], inertia[1], inertia[2]);
  CHECK(rms_difference(inertial, problem.reference) > 10.0 * inertia[0]);
  CHECK(median_order(inertia) == Approx(1.0).margin(0.25));
}

TEST_CASE("the errors of the adaptive rivals fall with their tolerance", "[convergence]") {
  SmoothProblem problem;
  for (const Method method : {Method::arkode, Method::adams, Method::automatic}) {
    std::vector<double> errors;
    for (const double tolerance : {1e-5, 1e-6, 1e-7, 1e-8}) {
      const auto y = integrate(problem.ode, with_tolerance(method, tolerance), 0.0, problem.state.values, end);
      errors.push_back(rms_difference(y, problem.reference));
    }
    CAPTURE(static_cast<int>(method), errors[0], errors[1], errors[2], errors[3]);
    CHECK(errors[0] < 3e-4);
    CHECK(errors[3] < 3e-7);
    CHECK(errors[3] < 0.05 * errors[0]);
  }
}

TEST_CASE("auto changes to CVODE where RKC2's steps take many stages, and only there", "[convergence]") {
  // The wavy cell's spectral radius is about 100: steps of 1e-3 take two stages, steps of 10 hundreds.
  SmoothProblem problem;
  for (const double longest : {1e-3, 10.0}) {
    IntegratorOptions options = with_tolerance(Method::automatic, 1e-4);
    options.maximum_step = longest;
    const auto integrator = make_integrator(problem.ode, options, 0.0, problem.state.values);
    std::vector<double> before(problem.state.values), between(before.size());
    double largest_jump = 0.0;
    while (integrator->time() < (longest < 1.0 ? 0.1 : 200.0)) {
      integrator->step(1e9);
      integrator->interpolate(integrator->time() - integrator->last_step(), between);
      largest_jump = std::max(largest_jump, largest_difference(between, before));
      before.assign(integrator->state().begin(), integrator->state().end());
    }
    const Statistics statistics = integrator->statistics();
    CAPTURE(longest, statistics.steps, statistics.explicit_steps);
    CHECK(largest_jump < 5e-3);  // a step begins where the last one ended, also across the change
    if (longest < 1.0)
      CHECK(statistics.explicit_steps == statistics.steps);
    else
      CHECK((statistics.explicit_steps >= 8 && statistics.explicit_steps < statistics.steps && statistics.newton_iterations > 0));
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

TEST_CASE("some components are interpolated as all are, bit for bit", "[convergence]") {
  SmoothProblem problem;
  const std::vector<int> some{7, 0, 3, static_cast<int>(problem.state.values.size()) - 1};
  for (const Method method : {Method::euler, Method::rkc2, Method::automatic, Method::cvode}) {
    const auto integrator = make_integrator(problem.ode, fixed(method, 1.0 / 256), 0.0, problem.state.values);
    std::vector<double> all(problem.state.values.size()), watched(all.size());
    for (int step = 0; step < 20; ++step) {
      integrator->step(end);
      for (const double back : {0.0, 0.3, 1.0}) {
        const double t = integrator->time() - back * integrator->last_step();
        integrator->interpolate(t, all);
        integrator->interpolate_some(t, some, watched);
        for (const int k : some) CHECK(watched[k] == all[k]);
      }
      if (step % 4 == 3) integrator->resume(integrator->time(), all, {});  // from now on CVODE's history is known
    }
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
