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
