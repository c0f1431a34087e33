// How long the first step after an event may be. An event changes the rate by a jump, and the error of the step that
// follows is proportional to that jump and to a power of the step. The coefficient is the stiffness around the purse string,
// much the same from event to event, so it is learnt instead of being found anew by failing.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

class EventStep {
 public:
  explicit EventStep(double power) : power_(power) {}

  /// The longest step advisable after an event that has changed the rate by `jump` (relative to the tolerance, root mean
  /// square) when a step of h is planned; infinity while nothing is known, and when the jump cannot move anything in h.
  double after(double jump, double h) {
    jump_ = jump * h > negligible ? jump : 0.0;
    if (jump_ == 0.0) return std::numeric_limits<double>::infinity();
    if (!(coefficient_ * jump > 0.0)) return std::numeric_limits<double>::infinity();
    return std::pow(aim / (coefficient_ * jump), 1.0 / power_);
  }
  /// A step that was accepted, with its error relative to the tolerance: counts if it is the first after an event.
  void learn(double h, double error) {
    if (jump_ > 0.0) coefficient_ = std::max(error / (jump_ * std::pow(h, power_)), forgetting * coefficient_);
    jump_ = 0.0;
  }

 private:
  static constexpr double aim = 0.7;         // error of the first step
  static constexpr double negligible = 0.1;  // of the tolerance
  static constexpr double forgetting = 0.7;  // per event: the coefficient rises at once and falls slowly
  double power_, jump_ = 0.0, coefficient_ = 0.0;
};

}  // namespace suture
