// Step sizes of a method of order 2 from its error estimates, which are relative to the tolerance and grow as h^3.
// Predictive control: the error coefficient is taken to go on changing as it did over the last two steps (Watts,
// Appl. Numer. Math. 1984; Gustafsson, ACM Trans. Math. Softw. 20 (1994) 496). What an event sets off dies away, so that
// errors fall step by step, and a controller that looks at the last one only lags behind.
#pragma once

#include <algorithm>
#include <cmath>

#include "integrate/event_step.hpp"

namespace suture {

class StepControl {
 public:
  /// The next step after one that was accepted. `cut`: it was shorter than the controller had asked for.
  double next(double h, double error, bool cut) {
    const double e = std::max(error, least_error);
    double factor = safety / std::cbrt(e);
    if (before_.h > 0.0) factor *= h / before_.h * std::cbrt(before_.error / e);
    event_step_.learn(h, e);
    before_ = error > least_error ? Step{h, e} : Step{};
    step_ = cut && factor >= largest_growth ? std::max(step_, largest_growth * h) : h * std::clamp(factor, 0.3, largest_growth);
    return step_;
  }
  /// The next try after one whose error was above 1; a state that was refused asks for a quarter.
  double retry(double h, double error) { return abandon(h * std::clamp(0.8 / std::cbrt(error), 0.1, 0.8)); }
  double retry_refused(double h) { return abandon(0.25 * h); }
  /// After an event that has changed the rate by `jump` (relative to the tolerance, root mean square).
  double restart(double jump) {
    before_ = {};
    return step_ = std::min(step_, event_step_.after(jump, step_));
  }
  void start(double h) { step_ = h; }
  /// What was asked for last.
  double step() const { return step_; }

 private:
  static constexpr double safety = 0.9, largest_growth = 5.0, least_error = 1e-9;

  double abandon(double h) {
    before_ = {};
    return step_ = h;
  }

  struct Step {
    double h = 0.0, error = 0.0;
  };
  double step_ = 0.0;
  Step before_;  // the last accepted one; none after an event or a failure
  EventStep event_step_{3.0};
};

}  // namespace suture
