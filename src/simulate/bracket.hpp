// Where a function of time changes its sign.
#pragma once

#include <algorithm>
#include <cmath>

namespace suture {

/// The end of a bracket of a root that is no wider than `resolution`, on the side where f is not negative; f(low) < 0 <= f(high).
/// Inverse quadratic interpolation where the three last points allow it, else bisection (Chandrupatla, Adv. Eng. Softw. 28 (1997)
/// 145): few evaluations where f is smooth, no more than some times those of bisection where it jumps.
template <class Function>
double first_not_negative(double low, double f_low, double high, double f_high, double resolution, const Function& f) {
  double t1 = high, f1 = f_high, t2 = low, f2 = f_low, part = 0.5;  // the last point, and the other side
  while (std::abs(t2 - t1) > resolution) {
    const double t = t1 + part * (t2 - t1), value = f(t);
    double t3 = t1, f3 = f1;
    if ((value < 0.0) != (f1 < 0.0)) t3 = t2, f3 = f2, t2 = t1, f2 = f1;
    t1 = t, f1 = value;
    const double least = 0.5 * resolution / std::abs(t2 - t1);
    const double xi = (t1 - t2) / (t3 - t2), phi = (f1 - f2) / (f3 - f2);
    const bool curved_little = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
    part = curved_little ? f1 / (f2 - f1) * f3 / (f2 - f3) + (t3 - t1) / (t2 - t1) * f1 / (f3 - f1) * f2 / (f3 - f2) : 0.5;
    part = std::clamp(part, std::min(least, 0.5), std::max(1.0 - least, 0.5));
  }
  return f1 >= 0.0 ? t1 : t2;
}

}  // namespace suture
