// The nonlinear solver of one implicit step, on tissues whose contacts switch inside the step.
#include <catch2/catch.hpp>
#include <cmath>

#include "integrate/minimising_newton.hpp"
#include "support/integration.hpp"
#include "support/random_tissue.hpp"
#include "support/toy_flow.hpp"
#include "suture/physics/term_sum.hpp"

using namespace suture;
using namespace suture::test;

namespace {

constexpr double contact_distance = 0.3;
constexpr NewtonTarget generous{.tolerance = 1.0, .give_up = 1e15};

struct Step {
  explicit Step(std::uint64_t seed, double gamma_in)
      : state(random_tissue(seed, {.spacing = 0.95, .roughness = 0.05, .strain = 0.05})),
        ode(state.tissue, 0, ode_options(contact_law(contact_distance), SpringLaw::quadratic, false), {}),
        gamma(gamma_in),
        q(state.values.begin(), state.values.begin() + ode.position_count()) {
    ode.begin_implicit_step(0.0, gamma, state.values);
  }
  double residual_norm(std::span<const double> at) {
    std::vector<double> f(at.size());
    REQUIRE(ode.residual(at, f) == Evaluation::ok);
    return largest(f);
  }
  /// |q - psi|^2/2 + gamma U(q), the function a step minimises.
  double objective(std::span<const double> at) const {
    Config config;
    config.contact = contact_law(contact_distance);
    auto y = state.values;
    std::copy(at.begin(), at.end(), y.begin());
    double sum = 0.0;
    for (const auto& [name, energy] :
         energy_by_term(make_cell_terms(state.tissue, config), 0.0, StateView(state.layout(), y)))
      sum += gamma * energy;
    for (std::size_t k = 0; k < at.size(); ++k) sum += 0.5 * (at[k] - state.values[k]) * (at[k] - state.values[k]);
    return sum;
  }
  TissueState state;
  TissueOde ode;
  double gamma;
  std::vector<double> q;
};

}  // namespace

TEST_CASE("a solve ends at a minimum of the step's function, the one a tight solve finds", "[unit]") {
  for (const std::uint64_t seed : {1, 2, 3})
    for (const double gamma : {1e-3, 1e-2}) {
      Step step(seed, gamma);
      const double before = step.objective(step.q), start = step.residual_norm(step.q);
      auto tight = step.q, loose = step.q;
      MinimisingNewton exact(step.ode, {.weight = 1e11, .largest_move = 0.05, .maximum_iterations = 100, .maximum_secants = 0});
      REQUIRE(exact.solve(gamma, tight, generous) == NewtonResult::converged);
      MinimisingNewton usual(step.ode, {.weight = 1e5, .largest_move = 0.05, .maximum_iterations = 30, .maximum_secants = 0});
      REQUIRE(usual.solve(gamma, loose, generous) == NewtonResult::converged);
      CAPTURE(seed, gamma, start, exact.counts().iterations, usual.counts().iterations);
      CHECK(step.residual_norm(tight) < 1e-9);
      CHECK(step.objective(tight) < before);
      CHECK(rms_difference(tight, step.q) > 1e-4);
      CHECK(rms_difference(loose, tight) < 1e-5);
      CHECK(usual.counts().iterations < exact.counts().iterations);
      CHECK(exact.counts().failures == 0);
    }
}

TEST_CASE("secants find the minimum that Newton's method finds, without second derivatives while steps are short", "[unit]") {
  for (const std::uint64_t seed : {1, 2, 3})
    for (const double gamma : {1e-3, 1e-2, 5e-2}) {
      Step step(seed, gamma);
      auto by_newton = step.q, by_secants = step.q;
      const NewtonOptions options{.weight = 1e7, .largest_move = 0.05, .maximum_iterations = 100, .maximum_secants = 0};  // 74 for one: attraction is left out
      MinimisingNewton newton(step.ode, options);
      REQUIRE(newton.solve(gamma, by_newton, generous) == NewtonResult::converged);
      NewtonOptions with_secants = options;
      with_secants.maximum_secants = 100;
      MinimisingNewton secants(step.ode, with_secants);
      REQUIRE(secants.solve(gamma, by_secants, generous) == NewtonResult::converged);
      CAPTURE(seed, gamma, newton.counts().iterations, secants.counts().iterations, secants.counts().linear_iterations);
      CHECK(rms_difference(by_newton, step.q) > 1e-4);
      CHECK(rms_difference(by_secants, by_newton) < 1e-7);
      if (gamma < 0.02) {
        CHECK(secants.counts().hessians == 1);  // the preconditioner's
        CHECK(newton.counts().hessians >= 3);
      } else {
        CHECK(secants.counts().hessians > 1);  // contacts that the preconditioner does not know: Newton's method takes over
      }
    }
}

TEST_CASE("no vertex moves further than it may in one iteration", "[unit]") {
  Step step(4, 1.0);
  auto q = step.q;
  MinimisingNewton newton(step.ode, {.weight = 1e3, .largest_move = 1e-3, .maximum_iterations = 1});
  newton.solve(step.gamma, q, {.tolerance = 1e-12, .give_up = 1e9});
  CHECK(newton.counts().iterations == 1);
  CHECK(newton.counts().failures == 1);
  CHECK(q == step.q);  // an unfinished solve leaves its input alone
}

TEST_CASE("a correction the error test would refuse ends the solve early", "[unit]") {
  Step step(5, 0.05);
  auto q = step.q;
  MinimisingNewton newton(step.ode, {.weight = 1e5, .largest_move = 0.05, .maximum_iterations = 50});
  CHECK(newton.solve(step.gamma, q, {.tolerance = 1.0, .give_up = 10.0}) == NewtonResult::too_long);
  CHECK(newton.counts().early_exits == 1);
  CHECK(newton.counts().failures == 0);
}

TEST_CASE("failures are reported: refused states and values that are not numbers", "[unit]") {
  std::vector<double> psi(5, 1.0), q(4, 1.0);
  ToyFlow refusing(4, [](auto) { return Evaluation::refused; });
  refusing.begin_implicit_step(0.0, 0.1, psi);
  MinimisingNewton first(refusing, {.weight = 1e4, .largest_move = 10.0});
  CHECK(first.solve(0.1, q, generous) == NewtonResult::not_converged);
  CHECK(first.counts().failures == 1);

  long calls = 0;  // every trial is refused, the start is not
  ToyFlow trapped(4, [&](auto) { return ++calls == 1 ? Evaluation::ok : Evaluation::refused; });
  trapped.begin_implicit_step(0.0, 0.1, psi);
  MinimisingNewton second(trapped, {.weight = 1e8, .largest_move = 10.0});
  CHECK(second.solve(0.1, q, generous) == NewtonResult::not_converged);
  CHECK(calls > 3);

  ToyFlow plain(4);
  std::vector<double> not_numbers(4, NAN);
  plain.begin_implicit_step(0.0, 0.1, psi);
  MinimisingNewton third(plain, {.weight = 1e4, .largest_move = 10.0});
  CHECK(third.solve(0.1, not_numbers, generous) == NewtonResult::not_converged);
}

TEST_CASE("a quadratic problem is solved to the last digit asked for", "[unit]") {
  ToyFlow toy(4);
  std::vector<double> psi(5, 1.0), q(4, 0.0);
  const double gamma = 0.3;
  toy.begin_implicit_step(0.0, gamma, psi);
  MinimisingNewton newton(toy, {.weight = 1e10, .largest_move = 10.0, .maximum_iterations = 20});
  REQUIRE(newton.solve(gamma, q, generous) == NewtonResult::converged);
  for (int k = 0; k < 4; ++k) CHECK(q[k] == Approx(1.0 / (1.0 + gamma * toy.stiffness(k))).margin(1e-9));
  CHECK(newton.counts().setups == 1);
}

TEST_CASE("a step that its limits turn uphill is shortened as a whole instead", "[unit]") {
  struct Uphill final : ToyFlow {
    using ToyFlow::ToyFlow;
    void limit_step(std::span<const double>, std::span<double> d) const override {
      for (double& c : d) c = -c;
    }
    double step_limit(std::span<const double>, std::span<const double>) const override { return 0.5; }
  } flow(6);
  const std::vector<double> psi{1, 2, 3, 4, 5, 6, 1};
  flow.begin_implicit_step(0.0, 0.5, psi);
  MinimisingNewton newton(flow, {.weight = 1e4, .largest_move = 100.0, .maximum_secants = 0});
  std::vector<double> q(psi.begin(), psi.begin() + 6);
  REQUIRE(newton.solve(0.5, q, generous) == NewtonResult::converged);
  for (std::size_t k = 0; k < q.size(); ++k) CHECK(q[k] == Approx(psi[k] / (1.0 + 0.5 * flow.stiffness(k))).epsilon(1e-3));
}

namespace {

/// Component k is drawn towards 1 by a spring and stopped by a wall, a thousand times as stiff; P is the identity and knows of neither.
struct Walls final : ToyFlow {
  static constexpr double stiffness = 1e3;
  Walls(std::vector<double> springs, std::vector<double> walls)
      : ToyFlow(static_cast<int>(springs.size())), spring(std::move(springs)), wall(std::move(walls)) {
    begin_implicit_step(0.0, 1.0, std::vector<double>(spring.size() + 1, 1.0));
  }
  Evaluation residual(std::span<const double> q, std::span<double> f) override {
    at.assign(q.begin(), q.end());
    for (std::size_t k = 0; k < q.size(); ++k) f[k] = spring[k] * (q[k] - 1.0) + stiffness * std::max(0.0, q[k] - wall[k]);
    return Evaluation::ok;
  }
  void linearise() override { pressed = at; }
  void product(std::span<const double> v, std::span<double> out) override {
    for (std::size_t k = 0; k < v.size(); ++k) out[k] = v[k] * (spring[k] + (pressed[k] > wall[k] ? stiffness : 0.0));
  }
  void check_solved(std::span<const double> q) const {
    for (std::size_t k = 0; k < q.size(); ++k) CHECK(q[k] == Approx((spring[k] + stiffness * wall[k]) / (spring[k] + stiffness)).margin(1e-4));
  }
  std::vector<double> spring, wall, at, pressed;
};

}  // namespace

TEST_CASE("walls that are met on the way cost iterations, not failures", "[unit]") {
  std::vector<double> walls;
  for (int k = 1; k <= 8; ++k) walls.push_back(0.9 / k);
  Walls flow(std::vector<double>(8, 1.0), walls);
  for (const int secants : {0, 20}) {
    MinimisingNewton newton(flow, {.weight = 1e4, .largest_move = 10.0, .maximum_iterations = 20, .maximum_secants = secants});
    std::vector<double> q(8, 0.0);
    REQUIRE(newton.solve(1.0, q, generous) == NewtonResult::converged);
    flow.check_solved(q);
    CAPTURE(secants, newton.counts().iterations, newton.counts().residuals);
    CHECK(newton.counts().iterations <= 20);
    CHECK(newton.counts().residuals <= 100);
  }
}

TEST_CASE("secants that run into walls send the solve back to the prediction, not to a shorter step", "[unit]") {
  // Springs softer than P: the first secant is longer than what has been looked at and ends beyond the walls, at 1 instead of 0.52.
  Walls flow({0.35, 0.4, 0.45, 0.5}, std::vector<double>(4, 0.52));
  std::vector<double> q(4, 0.0);
  MinimisingNewton newton(flow, {.weight = 1e4, .largest_move = 10.0});
  CHECK(newton.solve(1.0, q, {.tolerance = 1.0, .give_up = 7000.0}) == NewtonResult::converged);
  CHECK(newton.counts().early_exits == 0);
  flow.check_solved(q);
}
