// The error that is asked for is the error that is made, and a limit is a limit.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "support/integration.hpp"

using namespace suture;
using namespace suture::test;

namespace {

constexpr Method every_method[] = {Method::cvode, Method::rkc2,   Method::automatic, Method::arkode, Method::adams,
                                   Method::euler, Method::verlet, Method::rk4};

TissueState relaxing_cell() {
  return wavy_cell(
      16, {.area_stiffness = 4.0, .membrane_stiffness = 1.0, .bending_stiffness = 0.02, .tau = 0.5, .memory = 0.2});
}

}  // namespace

TEST_CASE("the error of a smooth relaxation follows the tolerance", "[convergence]") {
  const TissueState state = relaxing_cell();
  const double end = 0.4, unit = state.tissue.mean_initial_rest_length();
  TissueOde ode(state.tissue, 0, ode_options(contact_law(0.05, 0.1, false)), {});
  const auto reference = integrate(ode, with_step(Method::rk4, 1.0 / 4096), 0.0, state.values, end);
  for (const Method method : {Method::cvode, Method::rkc2})
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
      Statistics statistics;
      const auto y = integrate(ode, with_tolerance(method, tolerance * unit), 0.0, state.values, end, &statistics);
      const double ratio = rms_difference(y, reference) / (tolerance * unit);
      CAPTURE(static_cast<int>(method), tolerance, ratio, statistics.steps, statistics.rate_evaluations);
      CHECK(ratio > 0.01);
      CHECK(ratio < 10.0);
    }
}

TEST_CASE("half of a tolerance for the error of a step is the whole of half the tolerance", "[convergence]") {
  const TissueState state = relaxing_cell();
  TissueOde ode(state.tissue, 0, ode_options(contact_law(0.05, 0.1, false)), {});
  const auto with = [&](Method method, double tolerance, double fraction) {
    IntegratorOptions options = with_tolerance(method, tolerance);
    options.local_error_fraction = fraction;
    options.switch_stages = 1.0;  // auto: CVODE as soon as it may
    Statistics statistics;
    const auto y = integrate(ode, options, 0.0, state.values, 4.0, &statistics);
    return std::pair(y, statistics.rate_evaluations);
  };
  CHECK(IntegratorOptions{}.local_error_fraction == Config{}.integrator.local_error_fraction);
  CHECK(with(Method::cvode, 0x1p-14, 0.5) == with(Method::cvode, 0x1p-15, 1.0));
  CHECK(with(Method::cvode, 0x1p-14, 0.5) != with(Method::cvode, 0x1p-14, 1.0));
  CHECK(with(Method::automatic, 0x1p-14, 0.5) != with(Method::automatic, 0x1p-14, 1.0));
  CHECK(with(Method::rkc2, 0x1p-14, 0.5) == with(Method::rkc2, 0x1p-14, 1.0));
}

TEST_CASE("a step never passes its limit and can end on it exactly", "[convergence]") {
  const TissueState state = relaxing_cell();
  for (const Method method : every_method) {
    TissueOde ode(state.tissue, 0, ode_options(contact_law(0.05, 0.1, false)), {});
    IntegratorOptions options = with_tolerance(method, 1e-5);
    options.time_step = 1e-3;
    const auto integrator = make_integrator(ode, options, 1.0, state.values);
    CAPTURE(static_cast<int>(method));
    CHECK(integrator->step(1.0) == 1.0);  // nothing to do, and nothing done
    CHECK(integrator->statistics().steps == 0);
    for (const double limit : {1.0 + 1e-7, 1.0123456789, 1.1, 1.1 + 1e-9, 1.3}) {
      int steps = 0;
      while (integrator->time() < limit) {
        const double before = integrator->time();
        const double reached = integrator->step(limit);
        CHECK(reached == integrator->time());
        CHECK(integrator->time() <= limit);
        CHECK(integrator->last_step() == Approx(integrator->time() - before).epsilon(1e-6));
        REQUIRE(++steps < 10000);
      }
      CHECK(integrator->time() == limit);
      CHECK(integrator->step(limit) == limit);
    }
  }
}

TEST_CASE("without a limit the integrator chooses its steps", "[convergence]") {
  const TissueState state = relaxing_cell();
  for (const Method method : every_method) {
    TissueOde ode(state.tissue, 0, ode_options(contact_law(0.05, 0.1, false)), {});
    IntegratorOptions options = with_tolerance(method, 1e-5);
    options.time_step = 1e-3;
    const auto integrator = make_integrator(ode, options, 0.0, state.values);
    for (int k = 0; k < 5; ++k) integrator->step(std::numeric_limits<double>::infinity());
    CAPTURE(static_cast<int>(method), integrator->time());
    CHECK(integrator->time() > 0.0);
    CHECK(integrator->time() < 1.0);
    CHECK(largest(integrator->state()) < 1.0);
  }
}
