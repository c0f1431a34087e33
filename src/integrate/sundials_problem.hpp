// What the rivals from SUNDIALS share: vectors, the rate as a C callback, constant weights, and exceptions carried around C frames.
#pragma once

#include <sundials/sundials_nvector.h>

#include <exception>
#include <string>

#include "suture/integrate/integrator.hpp"

namespace suture {

/// Owns its SUNDIALS objects; the C callbacks take a pointer to it, so it does not move.
class SundialsProblem {
 public:
  SundialsProblem(OdeSystem& system, const IntegratorOptions& options, std::span<const double> y);
  ~SundialsProblem();
  SundialsProblem(const SundialsProblem&) = delete;
  SundialsProblem& operator=(const SundialsProblem&) = delete;

  /// Callbacks; `problem` is the SundialsProblem.
  static int rate(double t, N_Vector y, N_Vector out, void* problem);
  static int weights(N_Vector y, N_Vector out, void* problem);

  /// Throws what a callback has thrown since the last call, if anything.
  void rethrow();
  /// Throws NumericalError "LIBRARY: CALL returned FLAG" for a negative flag.
  static void check(int flag, const char* call);
  /// `errors`: local errors of the failed step, or nullptr.
  [[noreturn]] void fail(const std::string& what, double t, double step, int order, N_Vector errors, int flag) const;

  SUNContext context = nullptr;
  N_Vector y = nullptr;        ///< result of the last step
  N_Vector scratch = nullptr;  ///< interpolated values and error estimates
  std::int64_t rate_evaluations = 0;

 private:
  OdeSystem* system_;
  IntegratorOptions options_;
  std::exception_ptr exception_;  // exceptions must not cross C frames
};

}  // namespace suture
