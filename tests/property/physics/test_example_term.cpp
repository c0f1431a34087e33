// The example of docs/how-to/add-a-term.md, compiled and checked.
#include <catch2/catch.hpp>

#include "support/derivative_check.hpp"
#include "support/random_tissue.hpp"

using namespace suture;
using namespace suture::test;

namespace {

// Substrate adhesion: every vertex is held by a spring to where it was.   U = sum_v k/2 |r_v - r_v(0)|^2
class SubstrateAdhesion final : public EnergyTerm {
 public:
  SubstrateAdhesion(double stiffness, const StateView& start)
      : stiffness_(stiffness), x_(start.x.begin(), start.x.end()), y_(start.y.begin(), start.y.end()) {}

  std::string_view name() const override { return "substrate"; }

  double energy(double, const StateView& state) const override {
    double sum = 0.0;
    for (std::size_t v = 0; v < x_.size(); ++v) {
      const double dx = state.x[v] - x_[v], dy = state.y[v] - y_[v];
      sum += 0.5 * stiffness_ * (dx * dx + dy * dy);
    }
    return sum;
  }

  void add_gradient(double, const StateView& state, MutableStateView gradient) const override {
    for (std::size_t v = 0; v < x_.size(); ++v) {
      gradient.x[v] += stiffness_ * (state.x[v] - x_[v]);
      gradient.y[v] += stiffness_ * (state.y[v] - y_[v]);
    }
  }

  void add_hessian(double, const StateView&, HessianSink& sink) const override {
    for (std::size_t v = 0; v < x_.size(); ++v)
      sink.add_block(static_cast<int>(v), static_cast<int>(v), {stiffness_, 0.0, 0.0, stiffness_});
  }

 private:
  double stiffness_;
  std::vector<double> x_, y_;
};

}  // namespace

TEST_CASE("the term of the how-to page passes the check it recommends", "[property]") {
  const TissueState start = random_tissue(1);
  TissueState moved = start;
  const std::vector<double> shift = random_direction(start, 7, 0.1);
  for (std::size_t i = 0; i < shift.size(); ++i) moved.values[i] += shift[i];
  const DerivativeReport report = check_derivatives(SubstrateAdhesion(3.0, start.view()), moved, 1);
  INFO(report.text());
  CHECK(report.passed());
}
