#include <catch2/catch.hpp>
#include <cmath>

#include "suture/errors.hpp"
#include "suture/setup/fire.hpp"

using namespace suture;

namespace {

FireOptions options(double tolerance) {
  return {.force_tolerance = tolerance,
          .maximum_iterations = 20000,
          .initial_time_step = 0.02,
          .maximum_time_step = 0.1,
          .minimum_time_step = 0.001,
          .maximum_displacement = 0.5};
}

}  // namespace

TEST_CASE("FIRE finds the minimum of an ill-conditioned bowl", "[unit]") {
  constexpr int size = 37;  // not a multiple of the vector lanes
  const auto stiffness = [](int i) { return std::pow(10.0, -2.0 + 4.0 * i / (size - 1)); };
  const GradientFunction gradient = [&](std::span<const double> q, std::span<double> g) {
    for (int i = 0; i < size; ++i) g[i] = stiffness(i) * (q[i] - i);
    return Evaluation::ok;
  };
  for (const double tolerance : {1e-3, 1e-8}) {
    std::vector<double> q(size, 0.0);
    const FireReport report = Fire(size).minimise(q, gradient, options(tolerance));
    CHECK(report.converged);
    CHECK(report.largest_force < tolerance);
    CHECK(report.iterations > 20);
    for (int i = 0; i < size; ++i) CHECK(q[i] == Approx(i).margin(tolerance / stiffness(i)));
  }
}

TEST_CASE("FIRE follows the curved valley of Rosenbrock's function", "[unit]") {
  const GradientFunction gradient = [](std::span<const double> q, std::span<double> g) {
    g[0] = -2.0 * (1.0 - q[0]) - 400.0 * q[0] * (q[1] - q[0] * q[0]);
    g[1] = 200.0 * (q[1] - q[0] * q[0]);
    return Evaluation::ok;
  };
  std::vector<double> q{-1.2, 1.0};
  FireOptions settings = options(1e-9);
  settings.maximum_time_step = 0.05;
  const FireReport report = Fire(2).minimise(q, gradient, settings);
  CHECK(report.converged);
  CHECK(report.uphill_stops > 0);
  CHECK(q[0] == Approx(1.0).margin(1e-7));
  CHECK(q[1] == Approx(1.0).margin(1e-7));
}

TEST_CASE("FIRE says when it has not converged", "[unit]") {
  const GradientFunction gradient = [](std::span<const double> q, std::span<double> g) {
    g[0] = q[0];
    return Evaluation::ok;
  };
  std::vector<double> q{1.0};
  FireOptions settings = options(1e-12);
  settings.maximum_iterations = 7;
  const FireReport report = Fire(1).minimise(q, gradient, settings);
  CHECK_FALSE(report.converged);
  CHECK(report.iterations == 7);
  CHECK(report.largest_force > 0.1);
}

TEST_CASE("FIRE steps back where the gradient is refused, and reports a refused start", "[unit]") {
  int refusals = 0;
  const GradientFunction gradient = [&](std::span<const double> q, std::span<double> g) {
    if (q[0] < 0.999) {
      ++refusals;
      return Evaluation::refused;
    }
    g[0] = 40.0 * (q[0] - 1.0);
    return Evaluation::ok;
  };
  std::vector<double> q{2.0};
  const FireReport report = Fire(1).minimise(q, gradient, options(1e-6));
  CHECK(report.converged);
  CHECK(refusals > 0);
  CHECK(q[0] == Approx(1.0).margin(1e-6));
  q[0] = 0.5;
  CHECK_THROWS_AS(Fire(1).minimise(q, gradient, options(1e-6)), NumericalError);
}

TEST_CASE("A Fire object can be used again and starts at rest", "[unit]") {
  const GradientFunction gradient = [](std::span<const double> q, std::span<double> g) {
    for (std::size_t i = 0; i < q.size(); ++i) g[i] = (i + 1.0) * q[i];
    return Evaluation::ok;
  };
  Fire fire(5);
  std::vector<double> first(5, 1.0), second(5, 1.0);
  fire.minimise(first, gradient, options(1e-6));
  fire.minimise(second, gradient, options(1e-6));
  CHECK(first == second);
}
