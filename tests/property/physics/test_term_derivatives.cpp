#include <catch2/catch.hpp>

#include "support/derivative_check.hpp"
#include "support/random_tissue.hpp"
#include "support/term_table.hpp"
#include "suture/physics/area_elasticity.hpp"

using namespace suture;
using namespace suture::test;

TEST_CASE("gradient and Hessian of every term are derivatives of its energy", "[property]") {
  REQUIRE_FALSE(term_table().empty());
  for (const TermCase& row : term_table())
    for (const std::uint64_t seed : {1, 2, 3}) {
      const TissueState state = row.make_state(seed);
      const DerivativeReport report = check_derivatives(*row.make_term(state), state, 100 * seed);
      INFO(row.name << ", seed " << seed << ": " << report.text());
      CHECK(report.passed());
    }
}

namespace {

/// Area elasticity with one deliberate mistake.
class BrokenArea final : public EnergyTerm {
 public:
  enum class Mistake { none, gradient, hessian, no_gradient };
  BrokenArea(const Tissue& tissue, Mistake mistake) : area_(tissue), mistake_(mistake) {}

  std::string_view name() const override { return "broken"; }
  double energy(double t, const StateView& state) const override { return area_.energy(t, state); }
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override {
    if (mistake_ == Mistake::no_gradient) return;
    area_.add_gradient(t, state, gradient);
    if (mistake_ == Mistake::gradient) gradient.y[3] *= 1.001;
  }
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override {
    area_.add_hessian(t, state, sink);
    if (mistake_ == Mistake::hessian) sink.add_block(2, 2, {1e-3, 0.0, 0.0, 0.0});
  }

 private:
  AreaElasticity area_;
  Mistake mistake_;
};

}  // namespace

TEST_CASE("the derivative check rejects wrong derivatives and accepts right ones", "[property]") {
  const TissueState state = random_tissue(5);
  const auto report = [&](BrokenArea::Mistake mistake) {
    return check_derivatives(BrokenArea(state.tissue, mistake), state, 9);
  };
  CHECK(report(BrokenArea::Mistake::none).passed());
  const DerivativeReport gradient = report(BrokenArea::Mistake::gradient),
                         hessian = report(BrokenArea::Mistake::hessian);
  INFO(gradient.text() << "\n" << hessian.text());
  CHECK(gradient.gradient_order < 1.2);
  CHECK(hessian.gradient_order > 1.8);
  CHECK(hessian.hessian_order < 1.2);
  CHECK_FALSE(gradient.passed());
  CHECK_FALSE(hessian.passed());
  CHECK_FALSE(report(BrokenArea::Mistake::no_gradient).passed());
}
