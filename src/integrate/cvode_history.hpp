// CVODE's memory of the steps behind it, which an event may keep. CVODE 6.4 can only start afresh (order 1, tiny steps;
// CVodeResizeHistory came with 7.3), which costs about ten steps per event, and a closure has thousands of events.
#pragma once

#include <sundials/sundials_nvector.h>

#include <optional>
#include <span>
#include <vector>

#include "integrate/fused_nvector.hpp"

namespace suture {

/// What CVODE's nonlinear system is made of: y - psi - gamma f(t, y) = 0 with psi = predicted - rl1 zn1. `rate` is room that CVODE
/// uses neither during a solve nor between two.
struct NonlinearSystem {
  double t, gamma, rl1;
  N_Vector predicted, rate, zn1;
};
std::optional<NonlinearSystem> nonlinear_system(void* cvode);

/// The Nordsieck array zn[j] = h^j y^(j)/j! of a CVODE instance whose vectors are of one family. The array is found
/// among the family's members behind the two vectors that CVODE's interface names, and every use is checked against
/// CVodeGetDky, so that a CVODE that keeps its history elsewhere is noticed and never damaged.
class CvodeHistory {
 public:
  CvodeHistory(void* cvode, const VectorFamily& family);

  /// Whether zn[0..order] has been found: compares them with CVODE's own derivatives at its present time; with the highest one
  /// only if this instance's array is `known` to be where it was at an event before.
  bool verified(N_Vector scratch, bool known);
  /// y[k] at t for these components only, with the bits of CVodeGetDky; false if the array is not where it was. Found by verified() before.
  bool interpolate(double t, std::span<const int> components, std::span<double> y, std::vector<double>& room);
  /// Moves the point of expansion by `shift` (model units of time, within the last step).
  void shift(double shift);
  /// zn[0] = y; the derivatives stay.
  void set_value(N_Vector y) { N_VScale(1.0, y, zn_[0]); }
  /// zn[1] = h f, the rate behind the event; returns the weighted norm of the change of the rate.
  double set_rate(N_Vector f, N_Vector weights);

 private:
  bool find();
  /// Whether zn[j] is the j-th derivative at t over `scale`.
  bool has_derivative(double t, int j, double scale, N_Vector scratch) const;

  void* cvode_;
  std::vector<N_Vector> zn_;  ///< 0 .. last order
  double h_ = 0.0;            ///< the step the array is scaled with
  double now_ = 0.0;          ///< CVODE's time
  const VectorFamily* family_;
};

}  // namespace suture
