// What an integrator needs to know of a problem. No SUNDIALS here.
#pragma once

#include <span>
#include <string>

#include "suture/model/parameters.hpp"

namespace suture {

class WorkerPool;

enum class Evaluation {
  ok,
  refused,  ///< recoverable: inverted cell, zero-length segment, non-finite value; the integrator retries a smaller step
};

class OdeSystem {
 public:
  virtual ~OdeSystem() = default;
  virtual int size() const = 0;
  /// dy/dt, a pure function of (t, y). y and out do not overlap; of a refused evaluation out may hold parts.
  virtual Evaluation rate(double t, std::span<const double> y, std::span<double> out) = 0;
  /// Whether a step from `before` to `after`, where the last evaluation was or nearly was, has jumped over something that a shorter
  /// one would meet: then cvode and rkc2 repeat it with a shorter one. A small step never does.
  virtual bool jumps(std::span<const double> /*before*/, std::span<const double> /*after*/) { return false; }
  /// "cell 12, vertex 3, x".
  virtual std::string component_name(int i) const = 0;
  /// Components 0 .. position_count()-1 are positions, the rest are rest lengths (own tolerances).
  virtual int position_count() const = 0;
  /// Why the last evaluation was refused, in words.
  virtual std::string refusal() const = 0;
  /// The threads that share the work on this system, for the integrator's vectors too. Default: the caller alone.
  virtual WorkerPool& workers();
};

/// A gradient flow with eliminable memory variables, seen by the minimising Newton solver (docs/explanation/numerics.md):
/// solve  q - psi_q + gamma dU/dq(q, m(q)) = 0  where q are the positions and m the rest lengths, which follow from q
/// by their own implicit step. All vectors are position vectors of length position_count().
class GradientFlowSystem : public OdeSystem {
 public:
  /// Fixes t, gamma and psi (length size(): positions and rest lengths), which has to stay as it is as long as the step lasts.
  virtual void begin_implicit_step(double t, double gamma, std::span<const double> psi) = 0;
  /// residual = q - psi_q + gamma dU/dq.
  virtual Evaluation residual(std::span<const double> q, std::span<double> residual) = 0;
  /// Stores the second derivatives at the point of the last residual evaluation, whose q must still be there.
  virtual void linearise() = 0;
  /// out = (I + gamma H) v at the last linearisation.
  virtual void product(std::span<const double> v, std::span<double> out) = 0;
  /// What set_up_preconditioner factors: an approximation of I + gamma H, which is the default, or all of it. A system
  /// that has one way only stays with it.
  virtual void choose_linear_solver(LinearSolver) {}
  /// Factors the preconditioner from the last linearisation.
  virtual void set_up_preconditioner() = 0;
  /// z = P^-1 r, P symmetric positive definite.
  virtual void precondition(std::span<const double> r, std::span<double> z) = 0;
  /// Takes from the step d at q what would go beyond the range in which the residual is near its linearisation.
  virtual void limit_step(std::span<const double> /*q*/, std::span<double> /*d*/) const {}
  /// The factor, at most 1, by which d would have to be shortened as a whole for the same purpose.
  virtual double step_limit(std::span<const double> /*q*/, std::span<const double> /*d*/) const { return 1.0; }
  /// Rest lengths that belong to q, into memory (length size() - position_count()).
  virtual void recover_memory(std::span<const double> q, std::span<double> memory) = 0;
};

}  // namespace suture
