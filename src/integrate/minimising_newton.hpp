// The nonlinear solver of one implicit step, as a minimisation (docs/explanation/numerics.md). Solves
//     F(q) = q - psi + gamma dU/dq = 0
// by preconditioned nonlinear conjugate gradients, which need no second derivatives. Where these tell of contacts that the
// preconditioner does not know: semi-smooth Newton with the CURRENT contact set, truncated preconditioned conjugate gradients,
// and a line search on the directional derivative, so that contacts may switch inside the iteration without failing the step.
#pragma once

#include <cstdint>
#include <span>

#include "integrate/vector_operations.hpp"
#include "kernels/aligned_buffer.hpp"
#include "suture/ode/ode_system.hpp"

namespace suture {

struct NewtonOptions {
  double weight = 1.0;          ///< 1/(absolute tolerance of positions)
  double largest_move = 0.06;   ///< of any component in one iteration, model units of length (half a membrane segment)
  int maximum_iterations = 20;  ///< of Newton's method: collapsed segments take many
  double forcing = 0.2;         ///< conjugate gradients stop at this fraction of the residual
  int maximum_secants = 20;     ///< iterations of nonlinear conjugate gradients before Newton's method is taken; 0: none
  bool always_set_up = false;   ///< the preconditioner at every linearisation: one that is meant to be exact
};

/// What a solve has to meet, in weighted RMS norm.
struct NewtonTarget {
  double tolerance = 0.0;       ///< of the remaining error
  double give_up = 0.0;         ///< correction beyond which the step would fail the error test anyway
};

enum class NewtonResult { converged, too_long, not_converged };

class MinimisingNewton {
 public:
  MinimisingNewton(GradientFlowSystem& system, const NewtonOptions& options);

  /// system.begin_implicit_step has been called. q: prediction in, solution out (positions only); a solve that does not
  /// converge leaves it alone.
  NewtonResult solve(double gamma, std::span<double> q, const NewtonTarget& target);

  /// The system has another size or other terms since the last solve.
  void system_changed();

  struct Counts {
    std::int64_t residuals = 0, iterations = 0, linear_iterations = 0, hessians = 0, setups = 0, early_exits = 0, failures = 0;
  };
  const Counts& counts() const { return counts_; }
  /// Why the last solve did not converge, one per position: the remaining error P^-1 F, or the correction that was too
  /// long; zero when the start was refused.
  std::span<const double> obstacle() const { return {z_, n_}; }

 private:
  void allocate();
  std::span<double> span(double* p) const { return {p, n_}; }
  Evaluation residual(std::span<const double> q, double* f);
  double norm(double squared) const;
  void refresh(double gamma);
  bool preconditioner_aged(double gamma) const;
  NewtonResult failed();
  /// z_ <- P^-1 f_; returns f.z.
  double precondition_residual();
  /// At q_. Returns f.z, which a new set-up changes; fz: before. renew: set P up anew unless this solve has done so.
  double linearise(double gamma, double fz, bool renew);
  /// Leaves the correction in trial_.
  bool too_long(std::span<const double> prediction, const NewtonTarget& target);
  NewtonResult given_up();  ///< after too_long
  /// Preconditioned nonlinear conjugate gradients (Polak & Ribiere 1969, not below zero) from q_, its residual f_ and
  /// z_ = P^-1 f_. Forces are piecewise linear, so the difference of two residuals is a product with the Hessian: an iteration
  /// costs a residual and an application of P, no second derivatives. Afterwards f_ is interpolated between residuals.
  /// fz = f.z before and after. False if q_ has not moved.
  bool secants(double& fz, double wanted);
  /// d <- approximate solution of (I + gamma H) d = -f; z_ holds P^-1 f.
  void conjugate_gradients(double fz, double target);
  /// Keeps d_ within the range of the linearisation, downhill.
  void limit_step();
  /// How many times the wanted error is accepted after so many Newton iterations.
  static double allowance(int iteration);
  /// Moves q_ along d_; false when no acceptable state was found.
  bool line_search();

  GradientFlowSystem* system_;
  VectorOperations operations_;
  NewtonOptions options_;
  std::size_t n_ = 0, padded_ = 0;
  AlignedBuffer buffer_;
  double *q_, *f_, *trial_, *z_, *d_, *r_, *p_;  // d_ and trial_ lend their room to what is needed at other times
  double preconditioner_gamma_ = 0.0;
  int preconditioner_age_ = 0, last_linear_ = 0, fresh_linear_ = 0;
  Counts counts_;
};

}  // namespace suture
