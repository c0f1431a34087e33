// How the integrators fail: in words, as the right exception, and never by crashing.
#include <catch2/catch.hpp>
#include <cmath>

#include "integrate/failure_report.hpp"
#include "support/integration.hpp"
#include "support/random_tissue.hpp"
#include "support/toy_flow.hpp"
#include "suture/errors.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

constexpr Method all_methods[] = {Method::cvode, Method::rkc2,   Method::automatic, Method::arkode, Method::adams,
                                  Method::euler, Method::verlet, Method::rk4};

IntegratorOptions toy_options(Method method) {
  IntegratorOptions options = with_tolerance(method, 1e-4);
  options.time_step = 0.01;
  options.largest_move = 10.0;
  options.vertex_mass = 0.01;  // verlet: nearly overdamped
  return options;
}

/// The message of the NumericalError that integrating to t = 5 ends with; empty when it does not.
std::string failure(OdeSystem& system, const IntegratorOptions& options, std::span<const double> y) {
  try {
    integrate(system, options, 0.0, y, 5.0);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a system that refuses every state fails in words from the start", "[unit]") {
  const std::vector<double> y(5, 1.0);
  for (const Method method : all_methods) {
    ToyFlow toy(4, [](auto) { return Evaluation::refused; });
    const std::string message = failure(toy, toy_options(method), y);
    CAPTURE(static_cast<int>(method));
    CHECK_THAT(message, Contains("t = 0") && Contains("step") && Contains("the toy refuses"));
    CHECK(toy.evaluations() >= 1);
  }
}

TEST_CASE("a system that refuses to go on names time, step and reason", "[unit]") {
  // Refused once the first component has decayed to exp(-0.5), that is after t = 0.5.
  const std::vector<double> y(5, 1.0);
  for (const Method method : all_methods) {
    ToyFlow toy(4, [](auto q) { return q[0] < std::exp(-0.5) ? Evaluation::refused : Evaluation::ok; });
    const std::string message = failure(toy, toy_options(method), y);
    CAPTURE(static_cast<int>(method), message);
    CHECK_THAT(message, Contains("t = 0.") && Contains("step") && Contains("order") && Contains("the toy refuses"));
    const double t = std::stod(message.substr(message.find("t = ") + 4));
    CHECK(t == Approx(0.5).margin(0.02));
  }
}

TEST_CASE("the state before a failure stays valid", "[unit]") {
  const std::vector<double> y(5, 1.0);
  for (const Method method : all_methods) {
    ToyFlow toy(4, [](auto q) { return q[0] < std::exp(-0.5) ? Evaluation::refused : Evaluation::ok; });
    const auto integrator = make_integrator(toy, toy_options(method), 0.0, y);
    bool failed = false;
    while (!failed && integrator->time() < 5.0) {
      try {
        integrator->step(5.0);
      } catch (const NumericalError&) {
        failed = true;
      }
    }
    CAPTURE(static_cast<int>(method));
    REQUIRE(failed);
    const double t = integrator->time();
    CHECK(t > 0.4);
    for (int k = 0; k < 4; ++k) CHECK(integrator->state()[k] == Approx(std::exp(-toy.stiffness(k) * t)).margin(0.02));
    std::vector<double> between(5);
    integrator->interpolate(t - 0.5 * integrator->last_step(), between);
    CHECK(between[0] > std::exp(-0.52));
  }
}

TEST_CASE("an implicit step that cannot converge names the worst components, not the largest coordinates", "[unit]") {
  // The residual jumps at q[2] = 0.5: no solution, whatever the step. Component 1 has the largest coordinate.
  class Jump final : public GradientFlowSystem {
   public:
    int size() const override { return 4; }
    int position_count() const override { return 4; }
    std::string component_name(int i) const override { return "component " + std::to_string(i); }
    std::string refusal() const override { return ""; }
    Evaluation rate(double, std::span<const double>, std::span<double> out) override {
      for (double& v : out) v = 0.0;
      out[2] = -1.0;
      return Evaluation::ok;
    }
    void begin_implicit_step(double, double gamma, std::span<const double> psi) override {
      gamma_ = gamma;
      psi_.assign(psi.begin(), psi.end());
    }
    Evaluation residual(std::span<const double> q, std::span<double> f) override {
      for (int k = 0; k < 4; ++k) f[k] = q[k] - psi_[k];
      f[2] += gamma_;
      if (q[2] < 0.5) f[2] += q[2] - psi_[2] > -0.1 ? 3.0 : -3.0;
      return Evaluation::ok;
    }
    void linearise() override {}
    void product(std::span<const double> v, std::span<double> out) override {
      std::copy(v.begin(), v.end(), out.begin());
    }
    void set_up_preconditioner() override {}
    void precondition(std::span<const double> r, std::span<double> z) override {
      std::copy(r.begin(), r.end(), z.begin());
    }
    void recover_memory(std::span<const double>, std::span<double>) override {}

   private:
    double gamma_ = 0.0;
    std::vector<double> psi_;
  } system;
  const std::vector<double> y{0.0, 1000.0, 1.0, 0.0};
  const std::string message = failure(system, toy_options(Method::cvode), y);
  CAPTURE(message);
  CHECK_THAT(message, Contains("did not converge") && Contains("worst: component 2 ("));
}

TEST_CASE("the worst components are the five with the largest errors, in units of their tolerances", "[unit]") {
  ToyFlow toy(4);
  IntegratorOptions options;
  options.position_tolerance = 0.1;
  options.rest_length_tolerance = 0.01;
  const auto indices = [&](std::vector<double> errors) {
    std::vector<int> found;
    for (const WorstComponent& w : worst_components(toy, errors, options)) found.push_back(w.index);
    return found;
  };
  CHECK(indices({}) == std::vector<int>{});
  CHECK(indices({0.0, 0.0, NAN, 0.0, 0.0}) == std::vector<int>{});
  CHECK(indices({1.0, -3.0, 0.0, 2.0, 0.25}) == std::vector<int>{1, 4, 3, 0});  // the last is a rest length
  CHECK(indices({3.0, NAN, 0.1, -4.0, 0.5, 0.6, 0.01}) == std::vector<int>{5, 4, 3, 0, 2});
  CHECK(worst_components(toy, std::vector{0.0, -0.3}, options)[0].error == Approx(3.0));
}

TEST_CASE("exceptions thrown inside an evaluation come out unchanged", "[unit]") {
  struct Special : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  const std::vector<double> y(5, 1.0);
  for (const Method method : all_methods)
    for (const long at : {1, 2, 5, 60}) {
      ToyFlow* self = nullptr;
      ToyFlow toy(4, [&](auto) {
        if (self->evaluations() >= at) throw Special("thrown at evaluation " + std::to_string(self->evaluations()));
        return Evaluation::ok;
      });
      self = &toy;
      CAPTURE(static_cast<int>(method), at);
      CHECK_THROWS_AS(integrate(toy, toy_options(method), 0.0, y, 50.0), Special);
    }
}

TEST_CASE("refusals that pass are overcome by smaller steps", "[unit]") {
  const std::vector<double> y(5, 1.0);
  for (const Method method : {Method::cvode, Method::rkc2}) {
    ToyFlow* self = nullptr;
    ToyFlow toy(4, [&](auto) { return self->evaluations() % 7 == 3 ? Evaluation::refused : Evaluation::ok; });
    self = &toy;
    Statistics statistics;
    const auto end = integrate(toy, toy_options(method), 0.0, y, 1.0, &statistics);
    CAPTURE(static_cast<int>(method));
    CHECK(end[0] == Approx(std::exp(-1.0)).margin(1e-2));
    CHECK(statistics.convergence_failures > 0);
  }
}

TEST_CASE("a tissue that starts inverted is refused with the cell's name", "[unit]") {
  TissueState state = random_tissue(1);
  for (int v = state.tissue.first_vertex(2); v < state.tissue.end_vertex(2); ++v) state.mutable_view().x[v] *= -1.0;
  for (const Method method : all_methods) {
    TissueOde ode(state.tissue, 0, ode_options(contact_law(0.2)), {});
    const std::string message = failure(ode, toy_options(method), state.values);
    CAPTURE(static_cast<int>(method), message);
    CHECK_THAT(message, Contains("cell 2 is inverted"));
  }
}
