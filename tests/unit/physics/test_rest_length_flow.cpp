#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "support/convergence_order.hpp"
#include "support/random_tissue.hpp"
#include "suture/physics/rest_length_flow.hpp"

using namespace suture;
using namespace suture::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// l0(t) at fixed length: it decays to (1 - xi) l + xi l0_ref as exp(-t/tau).
double exact(double start, double length, double reference, double tau, double memory, double t) {
  const double target = (1.0 - memory) * length + memory * reference;
  return target + (start - target) * std::exp(-t / tau);
}

}  // namespace

TEST_CASE("the exact relaxation at fixed length satisfies the flow", "[unit]") {
  const double tau = 3.0, memory = 0.4, length = 0.9, reference = 1.1, step = 1e-5;
  for (const double t : {0.0, 1.0, 7.0}) {
    const auto l0 = [&](double time) { return exact(1.5, length, reference, tau, memory, time); };
    CHECK((l0(t + step) - l0(t - step)) / (2 * step) ==
          Approx(rest_length_rate(l0(t), length, reference, tau, memory)));
  }
}

TEST_CASE("implicit Euler by exact elimination converges to the exact relaxation at first order", "[unit]") {
  const double tau = 3.0, memory = 0.4, length = 0.9, reference = 1.1, end = 2.0;
  std::vector<double> errors;
  for (int steps = 40; steps <= 640; steps *= 2) {
    double l0 = 1.5;
    for (int k = 0; k < steps; ++k) l0 = implicit_rest_length(l0, end / steps, length, reference, tau, memory);
    errors.push_back(std::abs(l0 - exact(1.5, length, reference, tau, memory, end)));
  }
  CHECK(median_order(errors) == Approx(1.0).margin(0.03));
}

TEST_CASE("the elimination solves the implicit equation and knows its slope", "[unit]") {
  const double psi = 0.13, gamma = 0.7, length = 0.2, reference = 0.11, tau = 2.5;
  for (const double memory : {0.0, 0.5, 3.0}) {
    const double l0 = implicit_rest_length(psi, gamma, length, reference, tau, memory);
    CHECK(l0 - gamma * rest_length_rate(l0, length, reference, tau, memory) == Approx(psi).epsilon(1e-14));
    const double slope = implicit_rest_length(psi, gamma, length + 1.0, reference, tau, memory) - l0;
    CHECK(implicit_rest_length_slope(gamma, tau, memory) == Approx(slope).margin(1e-14));
  }
}

TEST_CASE("an elastic membrane does not flow at all", "[unit]") {
  CHECK(rest_length_rate(0.1, 5.0, 0.2, infinity, 0.7) == 0.0);
  CHECK(implicit_rest_length(0.1, 3.0, 5.0, 0.2, infinity, 0.7) == 0.1);
  CHECK(implicit_rest_length_slope(3.0, infinity, 0.7) == 0.0);
}

TEST_CASE("every segment flows with tau and memory of its cell", "[unit]") {
  const TissueState state = random_tissue(3);
  std::vector<double> rate(state.layout().size(), 0.0), reference(state.tissue.vertex_count(), 0.2);
  const MutableStateView view(state.layout(), rate);
  add_rest_length_rate(state.tissue, reference, state.view(), view);
  const StateView now = state.view();
  for (int v = 0; v < state.tissue.vertex_count(); ++v) {
    const int next = state.tissue.next(v);
    const CellMaterial& material = state.tissue.material(state.tissue.cell_of(v));
    const double length = std::hypot(now.x[next] - now.x[v], now.y[next] - now.y[v]), l0 = now.rest_length[v];
    REQUIRE(view.rest_length[v] == Approx(-((l0 - length) + material.memory * (length - 0.2)) / material.tau));
    REQUIRE(view.x[v] == 0.0);
  }
  std::vector<double> by_default(state.layout().size(), 0.0), by_initial(state.layout().size(), 0.0);
  add_rest_length_rate(state.tissue, {}, state.view(), MutableStateView(state.layout(), by_default));
  add_rest_length_rate(state.tissue, state.tissue.initial_rest_lengths(), state.view(),
                       MutableStateView(state.layout(), by_initial));
  CHECK(by_default == by_initial);
}
