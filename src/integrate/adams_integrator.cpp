// CVODE's Adams formulas with a fixed-point iteration, Anderson-accelerated: implicit in name, but it needs no derivatives
// and its step is bounded by stiffness, as that of any explicit method.
#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>

#include "integrate/fused_nvector.hpp"
#include "integrate/rivals.hpp"
#include "integrate/sundials_problem.hpp"

namespace suture {

namespace {

constexpr int anderson_depth = 3;
constexpr double latest_time = 1e300;  // stands for "no limit" and replaces an earlier one

class AdamsIntegrator final : public Integrator {
 public:
  AdamsIntegrator(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);
  ~AdamsIntegrator() override { destroy(); }

  double step(double limit) override;
  double time() const override { return time_; }
  std::span<const double> state() const override { return values(problem_->y); }
  double last_step() const override { return last_step_; }
  int last_order() const override;
  void interpolate(double t, std::span<double> y) const override;
  Statistics statistics() const override;
  /// Starts afresh: CVODE's Adams history is not kept.
  void resume(double t, std::span<const double> y, std::span<const int> source) override;

 private:
  void create(std::span<const double> y);
  void destroy();

  OdeSystem* system_;
  IntegratorOptions options_;
  std::unique_ptr<SundialsProblem> problem_;
  void* cvode_ = nullptr;
  SUNNonlinearSolver solver_ = nullptr;
  double time_, last_step_ = 0.0;
  Statistics before_;  // until the last resume
};

AdamsIntegrator::AdamsIntegrator(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y)
    : system_(&system), options_(options), time_(t) {
  try {
    create(y);
  } catch (...) {
    destroy();
    throw;
  }
}

void AdamsIntegrator::destroy() {
  CVodeFree(&cvode_);
  if (solver_ != nullptr) SUNNonlinSolFree(solver_);
  solver_ = nullptr;
}

void AdamsIntegrator::create(std::span<const double> y) {
  const auto check = SundialsProblem::check;
  problem_ = std::make_unique<SundialsProblem>(*system_, options_, y);
  cvode_ = CVodeCreate(CV_ADAMS, problem_->context);
  check(CVodeInit(cvode_, SundialsProblem::rate, time_, problem_->y), "CVodeInit");
  check(CVodeSetUserData(cvode_, problem_.get()), "CVodeSetUserData");
  check(CVodeSetErrHandlerFn(cvode_, [](int, const char*, const char*, char*, void*) {}, nullptr), "CVodeSetErrHandlerFn");
  check(CVodeWFtolerances(cvode_, SundialsProblem::weights), "CVodeWFtolerances");
  check(CVodeSetMaxOrd(cvode_, options_.maximum_order), "CVodeSetMaxOrd");
  check(CVodeSetMaxNumSteps(cvode_, -1), "CVodeSetMaxNumSteps");
  check(CVodeSetMaxConvFails(cvode_, 40), "CVodeSetMaxConvFails");
  check(CVodeSetMaxErrTestFails(cvode_, 20), "CVodeSetMaxErrTestFails");
  if (options_.initial_step > 0.0) check(CVodeSetInitStep(cvode_, options_.initial_step), "CVodeSetInitStep");
  if (options_.maximum_step > 0.0) check(CVodeSetMaxStep(cvode_, options_.maximum_step), "CVodeSetMaxStep");
  solver_ = SUNNonlinSol_FixedPoint(problem_->y, anderson_depth, problem_->context);
  check(CVodeSetNonlinearSolver(cvode_, solver_), "CVodeSetNonlinearSolver");
}

void AdamsIntegrator::resume(double t, std::span<const double> y, std::span<const int>) {
  before_ = statistics();
  if (last_step_ > 0.0) options_.initial_step = 0.1 * last_step_;  // the order starts from 1
  destroy();
  time_ = t;
  last_step_ = 0.0;
  create(y);
}

double AdamsIntegrator::step(double limit) {
  if (!(limit > time_)) return time_;
  const double before = time_;
  SundialsProblem::check(CVodeSetMinStep(cvode_, 1e-13 * std::abs(before)), "CVodeSetMinStep");
  SundialsProblem::check(CVodeSetStopTime(cvode_, std::min(limit, latest_time)), "CVodeSetStopTime");
  const int flag = CVode(cvode_, std::isfinite(limit) ? limit : before + 1.0, problem_->y, &time_, CV_ONE_STEP);
  problem_->rethrow();
  if (flag < 0) {
    double h = 0.0;
    CVodeGetCurrentStep(cvode_, &h);
    const bool error_test = flag == CV_ERR_FAILURE && CVodeGetEstLocalErrors(cvode_, problem_->scratch) == CV_SUCCESS;
    const char* what = error_test ? "the error test failed repeatedly" : "the step did not succeed";
    problem_->fail(what, time_, h, last_order(), error_test ? problem_->scratch : nullptr, flag);
  }
  last_step_ = time_ - before;
  return time_;
}

int AdamsIntegrator::last_order() const {
  int order = 0;
  CVodeGetLastOrder(cvode_, &order);
  return order;
}

void AdamsIntegrator::interpolate(double t, std::span<double> y) const {
  SundialsProblem::check(CVodeGetDky(cvode_, t, 0, problem_->scratch), "CVodeGetDky");
  std::copy_n(values(problem_->scratch).begin(), y.size(), y.begin());
}

Statistics AdamsIntegrator::statistics() const {
  long steps = 0, error_failures = 0, convergence_failures = 0, iterations = 0;
  CVodeGetNumSteps(cvode_, &steps);
  CVodeGetNumErrTestFails(cvode_, &error_failures);
  CVodeGetNumNonlinSolvConvFails(cvode_, &convergence_failures);
  CVodeGetNumNonlinSolvIters(cvode_, &iterations);
  Statistics s;
  s.rate_evaluations = problem_->rate_evaluations;
  s.steps = s.explicit_steps = steps;
  s.newton_iterations = iterations;
  s.error_test_failures = error_failures;
  s.convergence_failures = convergence_failures;
  return s += before_;
}

}  // namespace

std::unique_ptr<Integrator> make_adams(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y) {
  return std::make_unique<AdamsIntegrator>(system, options, t, y);
}

}  // namespace suture
