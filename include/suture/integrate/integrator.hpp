// One face for every time integrator.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "suture/model/parameters.hpp"
#include "suture/ode/ode_system.hpp"

namespace suture {

/// Counts since construction (or summed over restarts).
struct Statistics {
  std::int64_t rate_evaluations = 0;
  std::int64_t steps = 0;
  std::int64_t explicit_steps = 0;  ///< of `steps`, those of explicit methods: what "auto" chose
  std::int64_t newton_iterations = 0;
  std::int64_t linear_iterations = 0;
  std::int64_t hessian_builds = 0;
  std::int64_t preconditioner_setups = 0;
  std::int64_t error_test_failures = 0;
  std::int64_t convergence_failures = 0;
  std::int64_t restarts = 0;
  Statistics& operator+=(const Statistics& other);
};

struct IntegratorOptions {
  Method method = Method::cvode;
  double position_tolerance = 0.0;     ///< absolute, model units of length
  double rest_length_tolerance = 0.0;  ///< absolute, model units of length
  double local_error_fraction = 0.5;   ///< CVODE's BDF: estimated error of a step at most this part of the tolerances
  double time_step = 0.0;              ///< fixed-step methods
  double initial_step = 0.0;           ///< 0: chosen
  double maximum_step = 0.0;           ///< 0: none
  double vertex_mass = 1.0;            ///< velocity Verlet
  double switch_stages = 8.0;          ///< automatic: rates per step of RKC2 from which CVODE takes over
  double largest_move = 0.06;          ///< of a vertex in one Newton iteration, model units of length
  int maximum_order = 3;               ///< forces have kinks: higher orders amplify what the solver leaves
  LinearSolver linear_solver = LinearSolver::structured;
  bool keep_history = true;            ///< a multistep method carries its past over an event
};

/// Advances one OdeSystem of fixed size. Throws NumericalError on failure; everything up to time() stays valid.
class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Takes one internal step, at most to `limit`; returns the new time. state() is y there. A limit that is not later
  /// than time() leaves everything as it is.
  virtual double step(double limit) = 0;
  /// Whether a stop at a time that is known beforehand costs no more than interpolating to it: no history to disturb.
  virtual bool stops_cheaply() const { return false; }
  virtual double time() const = 0;
  virtual std::span<const double> state() const = 0;
  virtual double last_step() const = 0;
  virtual int last_order() const = 0;
  /// y at t in [time() - last_step(), time()], to the order of the method.
  virtual void interpolate(double t, std::span<double> y) const = 0;
  /// The same, bit for bit, for who needs only some components: the others may be left as they are.
  virtual void interpolate_some(double t, std::span<const int> /*components*/, std::span<double> y) const { interpolate(t, y); }
  virtual Statistics statistics() const = 0;
  /// Goes on from (t, y) after an event inside the last step (time() - last_step() <= t <= time()) that changed the
  /// system's rate, its size or the state: component k of y carries on the past of the former component source[k]
  /// (empty source: of component k). The step size is kept as far as the method can.
  virtual void resume(double t, std::span<const double> y, std::span<const int> source) = 0;
};

/// What [integrator] asks for, in model units; `rest_length` is the mean l0(0) its tolerances refer to.
IntegratorOptions integrator_options(const Config& config, double rest_length);

/// Creates the integrator `options.method` names, started at (t, y). The system must outlive it.
std::unique_ptr<Integrator> make_integrator(OdeSystem& system, const IntegratorOptions& options, double t,
                                            std::span<const double> y);

}  // namespace suture
