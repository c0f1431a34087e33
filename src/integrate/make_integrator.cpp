#include <cmath>

#include "integrate/cvode_integrator.hpp"
#include "integrate/rivals.hpp"
#include "suture/errors.hpp"

namespace suture {

Statistics& Statistics::operator+=(const Statistics& o) {
  rate_evaluations += o.rate_evaluations;
  steps += o.steps;
  newton_iterations += o.newton_iterations;
  linear_iterations += o.linear_iterations;
  hessian_builds += o.hessian_builds;
  preconditioner_setups += o.preconditioner_setups;
  error_test_failures += o.error_test_failures;
  convergence_failures += o.convergence_failures;
  restarts += o.restarts;
  return *this;
}

std::unique_ptr<Integrator> make_integrator(OdeSystem& system, const IntegratorOptions& options, double t,
                                            std::span<const double> y) {
  switch (options.method) {
    case Method::rkc2: return make_rkc2(system, options, t, y);
    case Method::euler: return make_euler(system, options, t, y);
    case Method::rk4: return make_rk4(system, options, t, y);
    case Method::cvode: break;
  }
  auto* flow = dynamic_cast<GradientFlowSystem*>(&system);
  if (flow == nullptr) throw InputError("integrator.method \"cvode\" needs a gradient flow");
  return make_cvode(*flow, options, t, y);
}

}  // namespace suture
