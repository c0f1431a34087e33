// RKC2 or CVODE, whichever the stiffness at hand makes cheaper. The choice depends on counted evaluations and on the step,
// never on a clock, so a run can be repeated.
#include <algorithm>
#include <cmath>

#include "integrate/cvode_integrator.hpp"
#include "integrate/rivals.hpp"

namespace suture {

namespace {

constexpr int probation = 8;       // steps over which a method is judged
constexpr double hysteresis = 0.5; // RKC2 comes back only where it would clearly stay
constexpr double forgetting = 0.9; // per judgement: what is kept of the memory of a dear CVODE

/// What CVODE's steps cost in evaluations of RKC2, which are dearer than bare ones by RKC2's own sums: from the times of the parts at
/// 1350 vertices (docs/benchmarks.md, "The other parts" and "Equal error").
double as_explicit_rates(const Statistics& s) {
  return 0.8 * static_cast<double>(s.rate_evaluations) + 0.7 * static_cast<double>(s.linear_iterations) +
         0.5 * static_cast<double>(s.hessian_builds) + 1.4 * static_cast<double>(s.preconditioner_setups) + 1.3 * static_cast<double>(s.steps);
}

class AutomaticIntegrator final : public Integrator {
 public:
  AutomaticIntegrator(GradientFlowSystem& system, const IntegratorOptions& options, double t, std::span<const double> y)
      : system_(&system), options_(options), current_(make_rkc2(system, options, t, y)) {}

  double step(double limit) override {
    judge();
    return current_->step(limit);
  }
  bool stops_cheaply() const override { return current_->stops_cheaply(); }
  double time() const override { return current_->time(); }
  std::span<const double> state() const override { return current_->state(); }
  double last_step() const override { return current_->last_step(); }
  int last_order() const override { return current_->last_order(); }
  void interpolate(double t, std::span<double> y) const override { current_->interpolate(t, y); }
  void interpolate_some(double t, std::span<const int> components, std::span<double> y) const override {
    current_->interpolate_some(t, components, y);
  }
  Statistics statistics() const override {
    Statistics total = before_;
    return total += current_->statistics();
  }
  void resume(double t, std::span<const double> y, std::span<const int> source) override { current_->resume(t, y, source); }

 private:
  void judge();
  void change();

  GradientFlowSystem* system_;
  IntegratorOptions options_;
  std::unique_ptr<Integrator> current_;
  bool explicit_ = true;
  double stiffness_ = 0.0;  // spectral radius that RKC2's stages amounted to when it was left
  double dear_ = 0.0;       // what a step of CVODE cost when it was left, as time goes by
  Statistics before_;       // of the methods before the present one
  Statistics judged_;       // of the present one, when it was last judged
  double judged_time_ = time();
};

/// Between steps, so that the last step of the old method can be interpolated until the next is asked for. RKC2 with s
/// stages is stable to h rho = 0.65 s^2, hence the stages it would need for CVODE's steps. Where contacts open and close in every
/// step, CVODE may cost more than these.
void AutomaticIntegrator::judge() {
  const Statistics now = current_->statistics();
  if (now.steps < judged_.steps + probation) return;
  const auto steps = static_cast<double>(now.steps - judged_.steps);
  const double rates = static_cast<double>(now.rate_evaluations - judged_.rate_evaluations) / steps;
  const double cost = (as_explicit_rates(now) - as_explicit_rates(judged_)) / steps;
  const double step = (time() - judged_time_) / steps;
  judged_ = now;
  judged_time_ = time();
  if (!(step > 0.0) || !(last_step() > 0.0)) return;
  if (explicit_) {
    stiffness_ = 0.65 * rates * rates / step;
    dear_ *= forgetting;
    if (rates > std::max(options_.switch_stages, dear_)) change();
  } else {
    const double stages = std::sqrt(stiffness_ * step / 0.65);
    if (!(stages < hysteresis * std::max(options_.switch_stages, cost))) return;
    dear_ = cost;
    change();
  }
}

void AutomaticIntegrator::change() {
  options_.initial_step = last_step();
  const double t = time();
  std::unique_ptr<Integrator> next = explicit_ ? make_cvode(*system_, options_, t, state()) : make_rkc2(*system_, options_, t, state());
  before_ += current_->statistics();
  current_ = std::move(next);
  explicit_ = !explicit_;
  judged_ = {};
}

}  // namespace

std::unique_ptr<Integrator> make_automatic(GradientFlowSystem& system, const IntegratorOptions& options, double t,
                                           std::span<const double> y) {
  return std::make_unique<AutomaticIntegrator>(system, options, t, y);
}

}  // namespace suture
