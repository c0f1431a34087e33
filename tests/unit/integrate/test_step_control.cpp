// The step controller of RKC2 on errors that are known, and what it makes of events.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "integrate/step_control.hpp"
#include "support/integration.hpp"
#include "support/toy_flow.hpp"

using namespace suture;
using namespace suture::test;

TEST_CASE("a constant error coefficient leads to steps of constant error", "[unit]") {
  StepControl control;
  double h = 1e-4;
  control.start(h);
  const auto error = [](double step) { return 5e5 * step * step * step; };
  for (int k = 0; k < 20; ++k) h = control.next(h, error(h), false);
  CHECK(error(h) == Approx(0.9 * 0.9 * 0.9).epsilon(1e-3));
}

TEST_CASE("what dies away is followed without lagging behind", "[unit]") {
  StepControl control;
  double t = 0.0, h = 0.003;
  const auto error = [&](double step) { return 1.8e7 * std::exp(-100.0 * t) * step * step * step; };
  double least = 1.0, most = 0.0;
  for (int k = 0; t < 0.05; ++k) {
    const double e = error(h);
    if (k > 1) least = std::min(least, e), most = std::max(most, e);  // two steps to learn from
    t += h;
    h = control.next(h, e, false);
  }
  // The plain rule, h 0.9 / cbrt(e), ends each step with 0.73 exp(-100 h): 0.27 after one of 0.01.
  CHECK(least > 0.5);
  CHECK(most < 1.0);
}

TEST_CASE("the first step after an event is as long as its jump allows", "[unit]") {
  StepControl control;
  control.start(1.0);
  const auto error = [](double jump, double step) { return 40.0 * jump * step * step * step; };
  double h = control.restart(2.0);
  CHECK(h == 1.0);  // nothing is known yet
  h = control.retry(h, error(2.0, h));
  while (error(2.0, h) > 1.0) h = control.retry(h, error(2.0, h));
  control.next(h, error(2.0, h), false);
  for (const double jump : {2.0, 16.0, 0.5}) {
    control.start(1.0);
    h = control.restart(jump);
    CHECK(error(jump, h) == Approx(0.7));
    control.next(h, error(jump, h), false);
  }
  control.start(0.06);
  CHECK(control.restart(2.0) == 0.06);  // what was short stays short
  control.start(1.0);
  CHECK(control.restart(0.09) == 1.0);  // what cannot move anything shortens nothing
}

TEST_CASE("a step that was cut does not shorten those that follow", "[unit]") {
  StepControl control;
  control.start(0.1);
  CHECK(control.next(1e-4, 1e-9, true) == 0.1);
  CHECK(control.next(0.01, 0.9 * 0.9 * 0.9, true) == Approx(0.01));  // unless its error says so
}

TEST_CASE("first steps fail at the first events only, and steps stop where they are told to", "[unit]") {
  for (const Method method : {Method::rkc2, Method::cvode}) {
    ToyFlow toy(30);
    std::vector<double> y(31, 1.0);
    const auto integrator = make_integrator(toy, with_tolerance(method, 1e-4), 0.0, y);
    CHECK(integrator->stops_cheaply() == (method == Method::rkc2));
    std::int64_t failures = 0;  // of first steps, from the third event on
    for (int event = 1; event <= 40; ++event) {
      while (integrator->time() < 0.2 * event) integrator->step(0.2 * event);
      CHECK(integrator->time() == 0.2 * event);
      y.assign(integrator->state().begin(), integrator->state().end());
      y[29] += event % 3 == 0 ? 0.2 : 1.0;  // kicks of the stiffest component
      integrator->resume(integrator->time(), y, {});
      const std::int64_t before = integrator->statistics().error_test_failures;
      integrator->step(1e300);
      if (event > 2) failures += integrator->statistics().error_test_failures - before;
    }
    CAPTURE(static_cast<int>(method));
    CHECK(failures <= (method == Method::rkc2 ? 4 : 10));  // of 38; without what was learnt CVODE has 69
  }
}
