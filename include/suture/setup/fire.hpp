// FIRE: molecular dynamics that is stopped whenever it runs uphill (Bitzek, Koskinen, Gaehler, Moseler & Gumbsch,
// Phys. Rev. Lett. 97, 170201, 2006), in the semi-implicit form with half a step back at each stop (Guenole et al.,
// Comput. Mater. Sci. 175, 109584, 2020). Unit mass per degree of freedom.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "suture/ode/ode_system.hpp"

namespace suture {

/// gradient = dU/dq at q; may refuse.
using GradientFunction = std::function<Evaluation(std::span<const double> q, std::span<double> gradient)>;

/// The published settings; only the force tolerance and the time scale depend on the problem.
struct FireOptions {
  double force_tolerance = 0.0;  ///< stop when the largest |dU/dq_i| is below
  int maximum_iterations = 0;
  double initial_time_step = 0.0;
  double maximum_time_step = 0.0;
  double minimum_time_step = 0.0;
  double maximum_displacement = 0.0;  ///< largest change of one component per step
  double time_step_growth = 1.1;
  double time_step_cut = 0.5;
  double initial_mixing = 0.25;
  double mixing_decay = 0.99;
  int delay = 20;  ///< downhill steps before the time step grows
};

struct FireReport {
  bool converged = false;
  int iterations = 0;
  int uphill_stops = 0;
  double largest_force = 0.0;
};

/// A minimisation between two iterations, besides q.
struct FireState {
  std::vector<double> velocity;
  double time_step = 0.0, mixing = 0.0;
  int downhill_steps = 0;
  FireReport report;
};

/// Minimises U from q in place. Reuse one object: its buffers are allocated once, the loop allocates nothing.
class Fire {
 public:
  explicit Fire(std::size_t size);
  /// between_steps: called before every iteration. Throws NumericalError when the gradient is refused at the start. A
  /// refusal on the way counts as an uphill stop.
  FireReport minimise(std::span<double> q, const GradientFunction& gradient, const FireOptions& options,
                      const std::function<void()>& between_steps = {});
  /// Before an iteration: to be saved with q. restore() makes the next minimise() go on from there.
  const FireState& state() const { return state_; }
  void restore(FireState state);

 private:
  FireState state_;
  bool restored_ = false;
  std::vector<double> gradient_;
};

}  // namespace suture
