// Going on after an event: nothing is lost, whatever the method.
#include <catch2/catch.hpp>
#include <cmath>

#include "support/integration.hpp"

using namespace suture;
using namespace suture::test;

TEST_CASE("an event that changes nothing changes nothing", "[convergence]") {
  const TissueState state =
      wavy_cell(10, {.area_stiffness = 4.0, .membrane_stiffness = 1.0, .bending_stiffness = 0.02, .tau = 0.5, .memory = 0.2});
  const double end = 0.25;
  struct Row {
    Method method;
    double step, expected;  ///< of fixed-step methods; difference from the run without events
  };
  // Adaptive: a few tolerances. Fixed steps: events cut them short, which changes the error by about itself: 0.2 h for Euler,
  // 10 h^2 for Verlet (whose velocities are interpolated linearly), h^2 for the cubic output of RK4.
  for (const Row& row : {Row{Method::cvode, 0.0, 2e-5}, Row{Method::rkc2, 0.0, 2e-5}, Row{Method::automatic, 0.0, 2e-5}, Row{Method::arkode, 0.0, 2e-5},
                         Row{Method::adams, 0.0, 2e-5}, Row{Method::euler, 1e-3, 2e-4}, Row{Method::verlet, 1e-3, 1e-5}, Row{Method::rk4, 1e-3, 1e-6}}) {
    TissueOde ode(state.tissue, 0, ode_options(contact_law(0.05, 0.1, false)), {});
    IntegratorOptions options = with_tolerance(row.method, 1e-6);
    options.time_step = row.step;
    const auto undisturbed = integrate(ode, options, 0.0, state.values, end);
    const auto integrator = make_integrator(ode, options, 0.0, state.values);
    std::vector<double> y(state.values.size());
    std::int64_t steps = 0;
    int events = 0;
    while (integrator->time() < end) {
      integrator->step(end);
      const double t = integrator->time() - 0.3 * integrator->last_step();
      if (integrator->time() < 0.03 * (events + 1) || integrator->time() == end) continue;
      integrator->interpolate(t, y);
      integrator->resume(t, y, {});
      ++events;
      CHECK(integrator->time() == t);
      CHECK(largest_difference(integrator->state(), y) == 0.0);
      CHECK(integrator->statistics().steps > steps);  // counts go on
      steps = integrator->statistics().steps;
    }
    CAPTURE(static_cast<int>(row.method), events);
    CHECK(events >= 5);
    CHECK(largest_difference(integrator->state(), undisturbed) < row.expected);
    CHECK(largest_difference(integrator->state(), state.values) > 0.01);
  }
}

TEST_CASE("kept history costs no steps, a fresh start does, renumbered components keep theirs", "[convergence]") {
  const TissueState state =
      wavy_cell(10, {.area_stiffness = 4.0, .membrane_stiffness = 1.0, .bending_stiffness = 0.02, .tau = 0.5, .memory = 0.2});
  const double end = 2.0;
  std::vector<int> same(state.values.size());
  for (std::size_t k = 0; k < same.size(); ++k) same[k] = static_cast<int>(k);
  std::int64_t events = 0;
  const auto steps_with_events = [&](bool keep, std::span<const int> source) {
    events = 0;
    TissueOde ode(state.tissue, 0, ode_options(contact_law(0.05, 0.1, false)), {});
    IntegratorOptions options = with_tolerance(Method::cvode, 1e-6);
    options.keep_history = keep;
    const auto integrator = make_integrator(ode, options, 0.0, state.values);
    std::vector<double> y(state.values.size());
    double next_event = 0.1;
    while (integrator->time() < end) {
      integrator->step(end);
      if (integrator->time() < next_event || integrator->time() == end) continue;
      integrator->interpolate(next_event, y);
      integrator->resume(next_event, y, source);
      next_event += 0.1;
      ++events;
    }
    return integrator->statistics().steps;
  };
  TissueOde ode(state.tissue, 0, ode_options(contact_law(0.05, 0.1, false)), {});
  const auto undisturbed = make_integrator(ode, with_tolerance(Method::cvode, 1e-6), 0.0, state.values);
  while (undisturbed->time() < end) undisturbed->step(end);
  const std::int64_t least = undisturbed->statistics().steps, kept = steps_with_events(true, {}), renumbered = steps_with_events(true, same),
                     afresh = steps_with_events(false, {});
  CAPTURE(least, kept, renumbered, afresh, events);
  CHECK(kept <= least + events);  // each event cuts a step in two, and costs no more than that
  CHECK(renumbered == kept);
  CHECK(afresh > 1.5 * kept);
}
