#include "simulate/closure_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

double forecast_closure(std::span<const WoundSample> samples, double closed_area) {
  constexpr double forever = std::numeric_limits<double>::infinity();
  if (samples.empty()) return forever;
  const auto area = [](const WoundSample& sample) { return sample.wound_area.value_or(0.0); };
  const WoundSample& now = samples.back();
  const double present = area(now), wanted = std::max(closed_area, 1e-6);
  if (present <= wanted) return 0.0;
  const WoundSample* before = &now;
  for (auto sample = samples.rbegin(); sample != samples.rend() && area(*before) < 2.0 * present; ++sample)
    if (area(*sample) > area(*before)) before = &*sample;
  if (before == &now) return forever;
  return (now.time - before->time) * std::log(present / wanted) / std::log(area(*before) / present);
}

}  // namespace suture
