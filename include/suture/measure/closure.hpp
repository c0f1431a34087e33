// What a closure curve A(t) comes to: closure times and closure rate (model.md section 7; Ton et al. 2023, Fig. 3).
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace suture {

/// Wound area against time. Times are since the purse string started and increase strictly.
struct WoundSeries {
  std::vector<double> time, area;
};

struct ClosureSummary {
  double maximum_area = 0.0;
  double time_of_maximum = 0.0;
  /// First time, at or after the maximum, at which the area has fallen to this fraction of the maximum, by linear
  /// interpolation; empty when it never does. Same time origin as the series.
  std::optional<double> t_50, t_25, t_10, t_05;
  /// 0.95 A_max/(t_05 - t(A_max)), the published definition; empty when t_05 is.
  std::optional<double> closure_rate;
};

/// Throws InputError for an empty series, unequal lengths, times that do not increase or areas that are negative or
/// NaN.
ClosureSummary summarise_closure(const WoundSeries& series);

/// First time at or after the maximum at which the area is at most fraction * maximum.
std::optional<double> time_to_fraction(const WoundSeries& series, double fraction);

/// Mean over seeds at the given times, each series interpolated linearly, zero after its end and its first value before
/// its beginning; closure rates of an ensemble are computed from it. Throws InputError as above.
WoundSeries mean_series(std::span<const WoundSeries> seeds, std::span<const double> times);

}  // namespace suture
