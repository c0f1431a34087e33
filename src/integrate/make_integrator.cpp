#include <cmath>

#include "integrate/cvode_integrator.hpp"
#include "integrate/rivals.hpp"
#include "suture/errors.hpp"

namespace suture {

Statistics& Statistics::operator+=(const Statistics& o) {
  rate_evaluations += o.rate_evaluations;
  steps += o.steps;
  explicit_steps += o.explicit_steps;
  newton_iterations += o.newton_iterations;
  linear_iterations += o.linear_iterations;
  hessian_builds += o.hessian_builds;
  preconditioner_setups += o.preconditioner_setups;
  error_test_failures += o.error_test_failures;
  convergence_failures += o.convergence_failures;
  restarts += o.restarts;
  return *this;
}

IntegratorOptions integrator_options(const Config& config, double rest_length) {
  const IntegratorParameters& p = config.integrator;
  IntegratorOptions options;
  options.method = p.method;
  options.position_tolerance = p.tolerance * rest_length;
  options.rest_length_tolerance = p.rest_length_tolerance * rest_length;
  options.local_error_fraction = p.local_error_fraction;
  options.time_step = p.time_step.value_or(0.01 * rest_length / std::sqrt(std::max(config.area.stiffness, 1e-3)));
  options.maximum_step = std::isfinite(p.maximum_step) ? p.maximum_step : 0.0;
  options.maximum_order = p.maximum_order;
  options.linear_solver = p.linear_solver;
  options.keep_history = p.keep_history;
  options.vertex_mass = p.vertex_mass;
  options.switch_stages = p.switch_stages;
  options.largest_move = 0.5 * rest_length;
  return options;
}

std::unique_ptr<Integrator> make_integrator(OdeSystem& system, const IntegratorOptions& options, double t,
                                            std::span<const double> y) {
  switch (options.method) {
    case Method::rkc2: return make_rkc2(system, options, t, y);
    case Method::euler: return make_euler(system, options, t, y);
    case Method::verlet: return make_verlet(system, options, t, y);
    case Method::rk4: return make_rk4(system, options, t, y);
    case Method::arkode: return make_arkode(system, options, t, y);
    case Method::adams: return make_adams(system, options, t, y);
    case Method::automatic:
    case Method::cvode: break;
  }
  auto* flow = dynamic_cast<GradientFlowSystem*>(&system);
  if (flow == nullptr) throw InputError("integrator.method \"cvode\" and \"auto\" need a gradient flow");
  return options.method == Method::automatic ? make_automatic(*flow, options, t, y) : make_cvode(*flow, options, t, y);
}

}  // namespace suture
