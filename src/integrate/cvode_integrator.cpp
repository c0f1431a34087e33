#include "integrate/cvode_integrator.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>
#include <vector>

#include "integrate/cvode_history.hpp"
#include "integrate/event_step.hpp"
#include "integrate/failure_report.hpp"
#include "integrate/fused_nvector.hpp"
#include "integrate/minimising_newton.hpp"
#include "suture/errors.hpp"

namespace suture {

namespace {

constexpr double nonlinear_coefficient = 0.1;  // CVODE's own default, stated because the early exit needs it
constexpr double time_resolution = 1e-13;      // shortest step relative to the time; a shorter one is a failure
constexpr double latest_time = 1e300;          // stands for "no limit" and replaces an earlier one

class CvodeIntegrator final : public Integrator {
 public:
  CvodeIntegrator(GradientFlowSystem& system, const IntegratorOptions& options, double t, std::span<const double> y);
  ~CvodeIntegrator() override;

  double step(double limit) override;
  double time() const override { return time_; }
  std::span<const double> state() const override { return values(y_); }
  double last_step() const override { return last_step_; }
  int last_order() const override;
  void interpolate(double t, std::span<double> y) const override;
  void interpolate_some(double t, std::span<const int> components, std::span<double> y) const override;
  void resume(double t, std::span<const double> y, std::span<const int> source) override;
  Statistics statistics() const override;

 private:
  void check(int flag, const char* call) const {
    if (flag < 0) throw NumericalError(fmt::format("CVODE: {} returned {}", call, flag));
  }
  void configure(double t);
  void start_afresh();
  void make_nonlinear_solver();
  N_Vector scratch() const;  // until the next solve
  int solve_step(N_Vector correction, double tolerance);
  double after_event(CvodeHistory& history);
  void learn_from_step();
  static int rate(double t, N_Vector y, N_Vector out, void* self);
  static int weights(N_Vector y, N_Vector w, void* self);
  [[noreturn]] void fail(const char* what, int flag);

  GradientFlowSystem* system_;
  IntegratorOptions options_;
  MinimisingNewton newton_;
  SUNContext context_ = nullptr;
  std::shared_ptr<VectorFamily> family_;
  N_Vector y_ = nullptr, interpolated_ = nullptr;  // during a step the state before it
  SUNNonlinearSolver solver_ = nullptr;
  void* cvode_ = nullptr;
  double time_ = 0.0, last_step_ = 0.0;
  double offset_ = 0.0;  // time - CVODE's time: CVODE cannot step back to an event inside its last step
  std::int64_t rates_ = 0, jumps_ = 0;
  std::int64_t forgotten_steps_ = 0, forgotten_failures_ = 0;  // when CVODE was started afresh
  std::vector<WorstComponent> unconverged_;  // of MinimisingNewton::obstacle of the last failed solve
  mutable std::vector<double> room_;  // of interpolate_some
  bool history_known_ = false;  // where CVODE keeps its past has been found at the last event
  EventStep event_step_{2.0};
  double first_step_ = 0.0;  // at most, when an event has just been passed
  std::exception_ptr exception_;  // thrown inside a callback; exceptions must not cross C frames
};

/// Tolerances become those of a step.
IntegratorOptions for_steps(IntegratorOptions options) {
  options.position_tolerance *= options.local_error_fraction;
  options.rest_length_tolerance *= options.local_error_fraction;
  return options;
}

CvodeIntegrator::CvodeIntegrator(GradientFlowSystem& system, const IntegratorOptions& options, double t,
                                 std::span<const double> y)
    : system_(&system),
      options_(for_steps(options)),
      newton_(system, {.weight = 1.0 / options_.position_tolerance,
                       .largest_move = options.largest_move,
                       .always_set_up = options.linear_solver == LinearSolver::sparse_direct}),
      family_(std::make_shared<VectorFamily>(system.workers())),
      time_(t) {
  system.choose_linear_solver(options.linear_solver);
  if (SUNContext_Create(nullptr, &context_) != 0) throw NumericalError("CVODE: no context");
  y_ = make_fused_vector(y.size(), context_, family_);
  interpolated_ = make_fused_vector(y.size(), context_, family_);
  std::copy(y.begin(), y.end(), values(y_).begin());
  cvode_ = CVodeCreate(CV_BDF, context_);
  if (cvode_ == nullptr) throw NumericalError("CVODE: cannot be created");
  configure(t);
}

CvodeIntegrator::~CvodeIntegrator() {
  CVodeFree(&cvode_);
  if (solver_ != nullptr) SUNNonlinSolFree(solver_);
  for (N_Vector v : {y_, interpolated_}) N_VDestroy(v);
  SUNContext_Free(&context_);
}

void CvodeIntegrator::configure(double t) {
  check(CVodeSetMaxOrd(cvode_, std::clamp(options_.maximum_order, 1, 5)), "CVodeSetMaxOrd");  // before CVodeInit takes memory for it
  check(CVodeInit(cvode_, rate, t, y_), "CVodeInit");
  check(CVodeSetUserData(cvode_, this), "CVodeSetUserData");
  check(CVodeSetErrHandlerFn(cvode_, [](int, const char*, const char*, char*, void*) {}, nullptr), "CVodeSetErrHandlerFn");
  check(CVodeWFtolerances(cvode_, weights), "CVodeWFtolerances");
  check(CVodeSetNonlinConvCoef(cvode_, nonlinear_coefficient), "CVodeSetNonlinConvCoef");
  check(CVodeSetMaxNumSteps(cvode_, -1), "CVodeSetMaxNumSteps");
  check(CVodeSetMaxConvFails(cvode_, 40), "CVodeSetMaxConvFails");
  check(CVodeSetMaxErrTestFails(cvode_, 20), "CVodeSetMaxErrTestFails");
  if (options_.initial_step > 0.0) check(CVodeSetInitStep(cvode_, options_.initial_step), "CVodeSetInitStep");
  if (options_.maximum_step > 0.0) check(CVodeSetMaxStep(cvode_, options_.maximum_step), "CVodeSetMaxStep");
  // Nothing is factored per step size, so it may change whenever that pays (11-15 % fewer steps).
  check(CVodeSetEtaFixedStepBounds(cvode_, 0.9, 1.1), "CVodeSetEtaFixedStepBounds");
  check(CVodeSetEtaConvFail(cvode_, 0.5), "CVodeSetEtaConvFail");
  make_nonlinear_solver();
  check(CVodeSetNonlinearSolver(cvode_, solver_), "CVodeSetNonlinearSolver");
}

void CvodeIntegrator::make_nonlinear_solver() {
  solver_ = SUNNonlinSolNewEmpty(context_);
  if (solver_ == nullptr) throw std::bad_alloc();
  solver_->content = this;
  solver_->ops->gettype = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_ROOTFIND; };
  solver_->ops->setsysfn = [](SUNNonlinearSolver, SUNNonlinSolSysFn) { return 0; };
  solver_->ops->getnumiters = [](SUNNonlinearSolver s, long* n) {
    *n = static_cast<long>(static_cast<CvodeIntegrator*>(s->content)->newton_.counts().iterations);
    return 0;
  };
  solver_->ops->getnumconvfails = [](SUNNonlinearSolver s, long* n) {
    *n = static_cast<long>(static_cast<CvodeIntegrator*>(s->content)->newton_.counts().failures);
    return 0;
  };
  solver_->ops->solve = [](SUNNonlinearSolver s, N_Vector, N_Vector correction, N_Vector, double tolerance, int, void*) {
    auto* self = static_cast<CvodeIntegrator*>(s->content);
    try {
      return self->solve_step(correction, tolerance);
    } catch (...) {
      self->exception_ = std::current_exception();
      return SUN_NLS_EXT_FAIL;
    }
  };
  solver_->ops->free = [](SUNNonlinearSolver s) {
    SUNNonlinSolFreeEmpty(s);
    return 0;
  };
}

N_Vector CvodeIntegrator::scratch() const {
  const std::optional<NonlinearSystem> system = nonlinear_system(cvode_);
  if (!system) throw NumericalError("CVODE: no nonlinear system");
  return system->rate;
}

/// One nonlinear solve: y - psi - gamma f(t, y) = 0 with psi = zn[0] - rl1 zn[1], the rest lengths eliminated.
int CvodeIntegrator::solve_step(N_Vector correction, double tolerance) {
  const std::optional<NonlinearSystem> system = nonlinear_system(cvode_);
  if (!system) return SUN_NLS_MEM_NULL;
  const auto [t, gamma, rl1, predicted, psi, zn1] = *system;
  N_VLinearSum(1.0, predicted, -rl1, zn1, psi);
  system_->begin_implicit_step(t + offset_, gamma, values(psi));
  const std::span<double> out = values(correction), start = values(predicted);
  const std::size_t n = system_->position_count();
  std::copy_n(start.begin(), n, out.begin());
  // The error test passes while the weighted norm of the correction is below tolerance / coefficient; the norm over all
  // components is what counts there, hence the ratio of lengths.
  const double ratio = std::sqrt(static_cast<double>(out.size()) / static_cast<double>(n));
  const NewtonTarget target{.tolerance = tolerance, .give_up = 1.2 * ratio * tolerance / nonlinear_coefficient};
  if (newton_.solve(gamma, out.first(n), target) != NewtonResult::converged) {
    unconverged_ = worst_components(*system_, newton_.obstacle(), options_);
    return SUN_NLS_CONV_RECVR;
  }
  if (system_->jumps(values(interpolated_), out)) {
    ++jumps_;
    return SUN_NLS_CONV_RECVR;
  }
  system_->recover_memory(out.first(n), out.subspan(n));
  N_VLinearSum(1.0, correction, -1.0, predicted, correction);
  return SUN_NLS_SUCCESS;
}

int CvodeIntegrator::rate(double t, N_Vector y, N_Vector out, void* user) {
  auto* self = static_cast<CvodeIntegrator*>(user);
  try {
    ++self->rates_;
    return self->system_->rate(t + self->offset_, values(y), values(out)) == Evaluation::ok ? 0 : 1;
  } catch (...) {
    self->exception_ = std::current_exception();
    return -1;
  }
}

int CvodeIntegrator::weights(N_Vector, N_Vector w, void* user) {
  // Constant weights: positions have no natural origin (translation invariance), rest lengths share their scale.
  const auto* self = static_cast<CvodeIntegrator*>(user);
  const std::span<double> out = values(w);
  const double position = 1.0 / self->options_.position_tolerance, rest = 1.0 / self->options_.rest_length_tolerance;
  const std::size_t n = self->system_->position_count();
  if (out[0] == position && out[out.size() - 1] == rest) return 0;
  std::fill_n(out.begin(), n, position);
  std::fill(out.begin() + static_cast<std::ptrdiff_t>(n), out.end(), rest);
  return 0;
}

double CvodeIntegrator::step(double limit) {
  if (!(limit > time_)) return time_;
  const double before = time_;
  N_VScale(1.0, y_, interpolated_);  // CVODE works in y_
  const bool first = first_step_ > 0.0;
  if (first) limit = std::min(limit, before + std::exchange(first_step_, 0.0));
  check(CVodeSetMinStep(cvode_, time_resolution * std::abs(before)), "CVodeSetMinStep");
  // CVODE takes the scale of its first step from the time it is asked for, which must be finite.
  check(CVodeSetStopTime(cvode_, std::min(limit - offset_, latest_time)), "CVodeSetStopTime");
  const int flag = CVode(cvode_, (std::isfinite(limit) ? limit : before + 1.0) - offset_, y_, &time_, CV_ONE_STEP);
  time_ = flag == CV_TSTOP_RETURN ? limit : time_ + offset_;
  if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
  if (flag == CV_CONV_FAILURE || flag == CV_NLS_FAIL) fail("the implicit step did not converge", flag);
  if (flag == CV_ERR_FAILURE) fail("the error test failed repeatedly", flag);
  if (flag < 0) fail("the integrator gave up", flag);
  last_step_ = time_ - before;
  if (first) learn_from_step();
  if (!(last_step_ > 0.0)) fail("the step size fell below the resolution of time", flag);
  return time_;
}

void CvodeIntegrator::fail(const char* what, int flag) {
  double h = 0.0;
  CVodeGetCurrentStep(cvode_, &h);
  const bool estimated = flag == CV_ERR_FAILURE && CVodeGetEstLocalErrors(cvode_, interpolated_) == CV_SUCCESS;
  const auto worst = estimated ? worst_components(*system_, values(interpolated_), options_) : unconverged_;
  throw NumericalError(failure_report(*system_, what, time_, h, last_order(), worst) + fmt::format(" (CVODE {})", flag));
}

double CvodeIntegrator::after_event(CvodeHistory& history) {
  double planned = 0.0;
  N_Vector weight = scratch();
  weights(y_, weight, this);
  CVodeGetCurrentStep(cvode_, &planned);
  return event_step_.after(history.set_rate(interpolated_, weight), planned);
}

void CvodeIntegrator::learn_from_step() {
  N_Vector weight = scratch();
  if (CVodeGetEstLocalErrors(cvode_, interpolated_) != CV_SUCCESS || CVodeGetErrWeights(cvode_, weight) != CV_SUCCESS) return;
  event_step_.learn(last_step_, N_VWrmsNorm(interpolated_, weight));
}

int CvodeIntegrator::last_order() const {
  int order = 0;
  CVodeGetLastOrder(cvode_, &order);
  return order;
}

void CvodeIntegrator::interpolate(double t, std::span<double> y) const {
  check(CVodeGetDky(cvode_, t - offset_, 0, interpolated_), "CVodeGetDky");
  std::copy_n(values(interpolated_).begin(), y.size(), y.begin());
}

void CvodeIntegrator::interpolate_some(double t, std::span<const int> components, std::span<double> y) const {
  if (history_known_ && CvodeHistory(cvode_, *family_).interpolate(t - offset_, components, y, room_)) return;
  check(CVodeGetDky(cvode_, t - offset_, 0, interpolated_), "CVodeGetDky");
  const std::span<const double> all = values(interpolated_);
  for (const int k : components) y[k] = all[k];
}

/// The steps behind the event stay CVODE's past: the solution and, for most components, its rate are continuous there.
/// What is not, the error test sees at the next step, as it sees any other rough spot.
void CvodeIntegrator::resume(double t, std::span<const double> y, std::span<const int> source) {
  CvodeHistory history(cvode_, *family_);
  const bool keep = options_.keep_history && last_step_ > 0.0 && history.verified(interpolated_, history_known_);
  history_known_ = keep;
  if (keep) history.shift(t - time_);
  if (!source.empty()) {
    family_->rearrange(source);
    unconverged_.clear();
  }
  newton_.system_changed();
  offset_ += t - time_;
  time_ = t;
  std::copy(y.begin(), y.end(), values(y_).begin());
  if (keep) {
    history.set_value(y_);
    ++rates_;
    if (system_->rate(t, values(y_), values(interpolated_)) == Evaluation::ok)
      first_step_ = after_event(history);
  } else {
    start_afresh();
  }
}

void CvodeIntegrator::start_afresh() {
  const Statistics so_far = statistics();
  forgotten_steps_ = so_far.steps;
  forgotten_failures_ = so_far.error_test_failures - newton_.counts().early_exits;
  check(CVodeReInit(cvode_, time_ - offset_, y_), "CVodeReInit");
  check(CVodeSetInitStep(cvode_, last_step_ > 0.0 ? 0.1 * last_step_ : options_.initial_step), "CVodeSetInitStep");
}

Statistics CvodeIntegrator::statistics() const {
  Statistics s;
  long steps = 0, rates = 0, setups = 0, error_fails = 0;
  int last = 0, current = 0;
  double h0, hlast, hcur, tcur;
  CVodeGetIntegratorStats(cvode_, &steps, &rates, &setups, &error_fails, &last, &current, &h0, &hlast, &hcur, &tcur);
  const MinimisingNewton::Counts& n = newton_.counts();
  s.steps = forgotten_steps_ + steps;
  s.rate_evaluations = rates_ + n.residuals;
  s.newton_iterations = n.iterations;
  s.linear_iterations = n.linear_iterations;
  s.hessian_builds = n.hessians;
  s.preconditioner_setups = n.setups;
  s.error_test_failures = forgotten_failures_ + error_fails + n.early_exits;  // an early exit stands in for a failed error test
  s.convergence_failures = n.failures + jumps_;
  return s;
}

}  // namespace

std::unique_ptr<Integrator> make_cvode(GradientFlowSystem& system, const IntegratorOptions& options, double t,
                                       std::span<const double> y) {
  return std::make_unique<CvodeIntegrator>(system, options, t, y);
}

}  // namespace suture
