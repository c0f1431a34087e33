// What method "auto" chooses, by counts alone.
#include <catch2/catch.hpp>
#include <cmath>

#include "support/toy_flow.hpp"
#include "suture/integrate/integrator.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Components that follow sin t, the stiffer the faster, with a preconditioner that knows how stiff each is or takes it for another.
class Driven final : public ToyFlow {
 public:
  explicit Driven(bool informed) : ToyFlow(300), informed_(informed) {}
  Evaluation rate(double t, std::span<const double> y, std::span<double> out) override {
    for (int k = 0; k < position_count(); ++k) out[k] = -stiffness(k) * (y[k] - std::sin(t));
    out[position_count()] = 0.0;
    return Evaluation::ok;
  }
  void begin_implicit_step(double t, double gamma, std::span<const double> psi) override {
    ToyFlow::begin_implicit_step(t, gamma, psi);
    time_ = t, gamma_ = gamma;
  }
  Evaluation residual(std::span<const double> q, std::span<double> f) override {
    ToyFlow::residual(q, f);
    for (int k = 0; k < position_count(); ++k) f[k] -= gamma_ * stiffness(k) * std::sin(time_);
    return Evaluation::ok;
  }
  void precondition(std::span<const double> r, std::span<double> z) override {
    for (int k = 0; k < position_count(); ++k) z[k] = r[k] / (1.0 + gamma_ * stiffness(informed_ ? k : position_count() - 1 - k));
  }

 private:
  bool informed_;
  double time_ = 0.0, gamma_ = 0.0;
};

Statistics run(Method method, bool informed) {
  Driven flow(informed);
  const std::vector<double> y(flow.size(), 0.0);
  const auto integrator = make_integrator(flow, {.method = method, .position_tolerance = 1e-4, .rest_length_tolerance = 1e-4, .maximum_step = 0.25, .largest_move = 10.0}, 0.0, y);
  while (integrator->time() < 60.0) integrator->step(60.0);
  return integrator->statistics();
}

}  // namespace

TEST_CASE("auto goes back to RKC2 where CVODE's steps cost more than the stages they replace", "[unit]") {
  for (const bool informed : {true, false}) {
    const Statistics rkc2 = run(Method::rkc2, informed), cvode = run(Method::cvode, informed), both = run(Method::automatic, informed);
    CAPTURE(informed, rkc2.steps, rkc2.rate_evaluations, cvode.steps, cvode.rate_evaluations, both.steps, both.explicit_steps, both.rate_evaluations);
    if (informed) {
      CHECK(3 * cvode.rate_evaluations < rkc2.rate_evaluations);
      CHECK(both.explicit_steps < both.steps / 4);
    } else {
      CHECK(cvode.rate_evaluations + cvode.linear_iterations > rkc2.rate_evaluations);
      CHECK(both.explicit_steps < both.steps);  // it was tried
      CHECK(both.explicit_steps > both.steps / 2);
    }
  }
}
