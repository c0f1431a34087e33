// Steps that jump over something are repeated with shorter ones.
#include <catch2/catch.hpp>
#include <cmath>

#include "support/integration.hpp"
#include "support/toy_flow.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// A wall that no step may carry the first component over by more than `resolved`.
class WalledToy final : public ToyFlow {
 public:
  static constexpr double wall = 0.5, resolved = 0.004;
  WalledToy() : ToyFlow(4) {}
  bool jumps(std::span<const double> before, std::span<const double> after) override {
    const bool over = before[0] > wall && after[0] < wall && before[0] - after[0] > resolved;
    found += over;
    return over;
  }
  int found = 0;
};

/// Its rest length moves ever faster, so that steps fail their error test although the positions are found.
class RememberingToy final : public ToyFlow {
 public:
  RememberingToy() : ToyFlow(4) {}
  Evaluation rate(double t, std::span<const double> y, std::span<double> out) override {
    const Evaluation evaluation = ToyFlow::rate(t, y, out);
    out[4] = acceleration * t;
    return evaluation;
  }
  void begin_implicit_step(double t, double gamma, std::span<const double> psi) override {
    ToyFlow::begin_implicit_step(t, gamma, psi);
    moved_ = psi[4] + gamma * acceleration * t;
  }
  void recover_memory(std::span<const double>, std::span<double> memory) override { memory[0] = moved_; }
  bool jumps(std::span<const double> before, std::span<const double>) override {
    compared_with.push_back(before[0]);
    return false;
  }
  std::vector<double> compared_with;

 private:
  static constexpr double acceleration = 50.0;
  double moved_ = 0.0;
};

}  // namespace

TEST_CASE("a step over a wall is repeated until it is short enough", "[unit]") {
  for (const Method method : {Method::cvode, Method::rkc2, Method::automatic}) {
    WalledToy toy;
    IntegratorOptions options = with_tolerance(method, 1e-2);
    options.largest_move = 10.0;
    const std::vector<double> start(5, 1.0);
    const auto integrator = make_integrator(toy, options, 0.0, start);
    int crossings = 0;
    double before = 1.0, longest = 0.0;
    while (integrator->time() < 2.0) {
      integrator->step(2.0);
      const double after = integrator->state()[0];
      longest = std::max(longest, before - after);
      if (before > WalledToy::wall && after < WalledToy::wall) {
        ++crossings;
        CHECK(before - after <= 1.01 * WalledToy::resolved);
      }
      before = after;
    }
    CAPTURE(static_cast<int>(method));
    CHECK(crossings == 1);
    CHECK(longest > 5.0 * WalledToy::resolved);
    CHECK(toy.found > 0);
    CHECK(integrator->statistics().convergence_failures >= toy.found);
    CHECK(before == Approx(std::exp(-2.0)).margin(0.03));
  }
}

TEST_CASE("a step is compared with where it began, not with where an attempt that failed had ended", "[unit]") {
  RememberingToy toy;
  IntegratorOptions options = with_tolerance(Method::cvode, 0.1);
  options.largest_move = 10.0;
  options.initial_step = 0.3;
  const std::vector<double> start(5, 1.0);
  const auto integrator = make_integrator(toy, options, 0.0, start);
  while (integrator->time() < 1.0) {
    const double before = integrator->state()[0];
    toy.compared_with.clear();
    integrator->step(1.0);
    for (const double from : toy.compared_with) CHECK(from == before);
    CHECK(!toy.compared_with.empty());
  }
  CHECK(integrator->statistics().error_test_failures > 0);
}
