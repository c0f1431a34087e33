// ARKODE's adaptive explicit Runge-Kutta method of order 3 (Bogacki and Shampine 1989): of the embedded pairs it has the
// longest stable step per evaluation, and stability, not accuracy, bounds the step here.
#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "integrate/fused_nvector.hpp"
#include "integrate/rivals.hpp"
#include "integrate/sundials_problem.hpp"

namespace suture {

namespace {

constexpr int order = 3;
constexpr double latest_time = 1e300;  // stands for "no limit" and replaces an earlier one

class ArkodeIntegrator final : public Integrator {
 public:
  ArkodeIntegrator(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);
  ~ArkodeIntegrator() override { ERKStepFree(&arkode_); }

  double step(double limit) override;
  double time() const override { return time_; }
  std::span<const double> state() const override { return accepted_; }
  double last_step() const override { return last_step_; }
  int last_order() const override { return order; }
  void interpolate(double t, std::span<double> y) const override;
  Statistics statistics() const override;
  void resume(double t, std::span<const double> y, std::span<const int> source) override;

 private:
  void create(std::span<const double> y);
  void retry();

  OdeSystem* system_;
  IntegratorOptions options_;
  std::unique_ptr<SundialsProblem> problem_;
  void* arkode_ = nullptr;
  double time_, last_step_ = 0.0;
  std::vector<double> accepted_;  // ARKODE computes stages in the vector it is given
  long refused_ = 0;
  Statistics before_;  // until the last resume
};

ArkodeIntegrator::ArkodeIntegrator(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y)
    : system_(&system), options_(options), time_(t) {
  try {
    create(y);
  } catch (...) {
    ERKStepFree(&arkode_);
    throw;
  }
}

void ArkodeIntegrator::create(std::span<const double> y) {
  const auto check = SundialsProblem::check;
  problem_ = std::make_unique<SundialsProblem>(*system_, options_, y);
  accepted_.assign(y.begin(), y.end());
  arkode_ = ERKStepCreate(SundialsProblem::rate, time_, problem_->y, problem_->context);
  check(ERKStepSetUserData(arkode_, problem_.get()), "ERKStepSetUserData");
  check(ERKStepSetErrHandlerFn(arkode_, [](int, const char*, const char*, char*, void*) {}, nullptr), "ERKStepSetErrHandlerFn");
  check(ERKStepWFtolerances(arkode_, SundialsProblem::weights), "ERKStepWFtolerances");
  check(ERKStepSetOrder(arkode_, order), "ERKStepSetOrder");
  // Cubic Hermite output: higher degrees would evaluate the rate at other times whenever output is asked for.
  check(ERKStepSetInterpolantDegree(arkode_, 3), "ERKStepSetInterpolantDegree");
  check(ERKStepSetMaxNumSteps(arkode_, -1), "ERKStepSetMaxNumSteps");
  check(ERKStepSetMaxErrTestFails(arkode_, 20), "ERKStepSetMaxErrTestFails");
  if (options_.initial_step > 0.0) check(ERKStepSetInitStep(arkode_, options_.initial_step), "ERKStepSetInitStep");
  if (options_.maximum_step > 0.0) check(ERKStepSetMaxStep(arkode_, options_.maximum_step), "ERKStepSetMaxStep");
}

void ArkodeIntegrator::resume(double t, std::span<const double> y, std::span<const int>) {
  before_ = statistics();
  refused_ = 0;
  if (last_step_ > 0.0) options_.initial_step = last_step_;
  ERKStepFree(&arkode_);
  time_ = t;
  last_step_ = 0.0;
  create(y);
}

/// ARKODE gives up when a stage is refused; start again from the last accepted state with a quarter of the step.
void ArkodeIntegrator::retry() {
  double h = 0.0;
  ERKStepGetCurrentStep(arkode_, &h);
  std::copy(accepted_.begin(), accepted_.end(), values(problem_->y).begin());
  SundialsProblem::check(ERKStepReset(arkode_, time_, problem_->y), "ERKStepReset");
  SundialsProblem::check(ERKStepSetInitStep(arkode_, 0.25 * h), "ERKStepSetInitStep");
  ++refused_;
}

double ArkodeIntegrator::step(double limit) {
  if (!(limit > time_)) return time_;
  const double target = std::isfinite(limit) ? limit : time_ + 1.0;
  double reached = time_;
  int flag = ARK_SUCCESS;
  for (int attempt = 0; attempt < 40; ++attempt) {
    SundialsProblem::check(ERKStepSetMinStep(arkode_, 1e-13 * std::abs(time_)), "ERKStepSetMinStep");
    SundialsProblem::check(ERKStepSetStopTime(arkode_, std::min(limit, latest_time)), "ERKStepSetStopTime");
    flag = ERKStepEvolve(arkode_, target, problem_->y, &reached, ARK_ONE_STEP);
    problem_->rethrow();
    const bool refused = flag == ARK_UNREC_RHSFUNC_ERR || flag == ARK_REPTD_RHSFUNC_ERR || flag == ARK_RHSFUNC_FAIL;
    if (!refused) break;
    retry();
  }
  if (flag < 0) {
    double h = 0.0;
    ERKStepGetCurrentStep(arkode_, &h);
    const bool error_test = flag == ARK_ERR_FAILURE && ERKStepGetEstLocalErrors(arkode_, problem_->scratch) == ARK_SUCCESS;
    const char* what = error_test ? "the error test failed repeatedly" : "the step did not succeed";
    problem_->fail(what, time_, h, order, error_test ? problem_->scratch : nullptr, flag);
  }
  last_step_ = reached - time_;
  time_ = reached;
  std::copy_n(values(problem_->y).begin(), accepted_.size(), accepted_.begin());
  return time_;
}

void ArkodeIntegrator::interpolate(double t, std::span<double> y) const {
  SundialsProblem::check(ERKStepGetDky(arkode_, t, 0, problem_->scratch), "ERKStepGetDky");
  std::copy_n(values(problem_->scratch).begin(), y.size(), y.begin());
}

Statistics ArkodeIntegrator::statistics() const {
  long steps = 0, error_failures = 0;
  ERKStepGetNumSteps(arkode_, &steps);
  ERKStepGetNumErrTestFails(arkode_, &error_failures);
  Statistics s;
  s.rate_evaluations = problem_->rate_evaluations;
  s.steps = s.explicit_steps = steps;
  s.error_test_failures = error_failures;
  s.convergence_failures = refused_;
  return s += before_;
}

}  // namespace

std::unique_ptr<Integrator> make_arkode(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y) {
  return std::make_unique<ArkodeIntegrator>(system, options, t, y);
}

}  // namespace suture
