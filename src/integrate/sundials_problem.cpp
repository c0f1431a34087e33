#include "integrate/sundials_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "integrate/failure_report.hpp"
#include "integrate/fused_nvector.hpp"
#include "suture/errors.hpp"

namespace suture {

SundialsProblem::SundialsProblem(OdeSystem& system, const IntegratorOptions& options, std::span<const double> start)
    : system_(&system), options_(options) {
  if (SUNContext_Create(nullptr, &context) != 0) throw NumericalError("SUNDIALS: no context");
  const auto family = std::make_shared<VectorFamily>(system.workers());
  y = make_fused_vector(start.size(), context, family);
  scratch = make_fused_vector(start.size(), context, family);
  std::copy(start.begin(), start.end(), values(y).begin());
}

SundialsProblem::~SundialsProblem() {
  N_VDestroy(y);
  N_VDestroy(scratch);
  SUNContext_Free(&context);
}

int SundialsProblem::rate(double t, N_Vector y, N_Vector out, void* problem) {
  auto* self = static_cast<SundialsProblem*>(problem);
  try {
    ++self->rate_evaluations;
    return self->system_->rate(t, values(y), values(out)) == Evaluation::ok ? 0 : 1;
  } catch (...) {
    self->exception_ = std::current_exception();
    return -1;
  }
}

int SundialsProblem::weights(N_Vector, N_Vector w, void* problem) {
  const auto* self = static_cast<SundialsProblem*>(problem);
  const std::span<double> out = values(w);
  const auto positions = static_cast<std::ptrdiff_t>(self->system_->position_count());
  std::fill(out.begin(), out.begin() + positions, 1.0 / self->options_.position_tolerance);
  std::fill(out.begin() + positions, out.end(), 1.0 / self->options_.rest_length_tolerance);
  return 0;
}

void SundialsProblem::rethrow() {
  if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
}

void SundialsProblem::check(int flag, const char* call) {
  if (flag < 0) throw NumericalError(fmt::format("SUNDIALS: {} returned {}", call, flag));
}

void SundialsProblem::fail(const std::string& what, double t, double step, int order, N_Vector errors, int flag) const {
  const std::span<const double> local = errors != nullptr ? std::span<const double>(values(errors)) : std::span<const double>();
  throw NumericalError(failure_report(*system_, what, t, step, order, worst_components(*system_, local, options_)) + fmt::format(" (SUNDIALS {})", flag));
}

}  // namespace suture
