// Starts with RKC2 and changes to CVODE where stiffness makes RKC2's steps dear. The choice depends on counted evaluations
// alone, never on a clock, so a run can be repeated.
#include "integrate/cvode_integrator.hpp"
#include "integrate/rivals.hpp"

namespace suture {

namespace {

constexpr int probation = 8;  // steps over which RKC2's rates per step are measured

class AutomaticIntegrator final : public Integrator {
 public:
  AutomaticIntegrator(GradientFlowSystem& system, const IntegratorOptions& options, double t, std::span<const double> y)
      : system_(&system), options_(options), current_(make_rkc2(system, options, t, y)) {}

  double step(double limit) override {
    if (explicit_) judge();
    return current_->step(limit);
  }
  double time() const override { return current_->time(); }
  std::span<const double> state() const override { return current_->state(); }
  double last_step() const override { return current_->last_step(); }
  int last_order() const override { return current_->last_order(); }
  void interpolate(double t, std::span<double> y) const override { current_->interpolate(t, y); }
  Statistics statistics() const override {
    Statistics total = before_;
    return total += current_->statistics();
  }

 private:
  /// Between steps, so that the last step of the old method can be interpolated until the next is asked for.
  void judge() {
    const Statistics now = current_->statistics();
    if (now.steps < judged_.steps + probation) return;
    const auto rates = static_cast<double>(now.rate_evaluations - judged_.rate_evaluations);
    const auto steps = static_cast<double>(now.steps - judged_.steps);
    judged_ = now;
    if (rates <= options_.switch_stages * steps) return;
    options_.initial_step = current_->last_step();
    std::unique_ptr<Integrator> implicit = make_cvode(*system_, options_, current_->time(), current_->state());
    before_ = now;
    current_ = std::move(implicit);
    explicit_ = false;
  }

  GradientFlowSystem* system_;
  IntegratorOptions options_;
  std::unique_ptr<Integrator> current_;
  bool explicit_ = true;
  Statistics before_, judged_;
};

}  // namespace

std::unique_ptr<Integrator> make_automatic(GradientFlowSystem& system, const IntegratorOptions& options, double t,
                                           std::span<const double> y) {
  return std::make_unique<AutomaticIntegrator>(system, options, t, y);
}

}  // namespace suture
