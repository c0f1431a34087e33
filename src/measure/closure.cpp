#include "suture/measure/closure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "suture/errors.hpp"

namespace suture {
namespace {

void check(const WoundSeries& series) {
  if (series.time.empty()) throw InputError("the wound series is empty");
  if (series.time.size() != series.area.size())
    throw InputError(fmt::format("{} times but {} wound areas", series.time.size(), series.area.size()));
  for (std::size_t i = 0; i < series.time.size(); ++i) {
    if (!(series.area[i] >= 0.0)) throw InputError(fmt::format("wound area {} at sample {}", series.area[i], i));
    if (i > 0 && !(series.time[i] > series.time[i - 1]))
      throw InputError(
          fmt::format("times do not increase at sample {}: {} after {}", i, series.time[i], series.time[i - 1]));
  }
}

std::size_t index_of_maximum(const WoundSeries& series) {
  return static_cast<std::size_t>(std::max_element(series.area.begin(), series.area.end()) - series.area.begin());
}

double value_at(const WoundSeries& series, double t) {
  if (t > series.time.back()) return 0.0;
  if (t <= series.time.front()) return series.area.front();
  const auto upper = std::lower_bound(series.time.begin(), series.time.end(), t);
  const auto i = static_cast<std::size_t>(upper - series.time.begin());
  const double weight = (t - series.time[i - 1]) / (series.time[i] - series.time[i - 1]);
  return (1.0 - weight) * series.area[i - 1] + weight * series.area[i];
}

}  // namespace

std::optional<double> time_to_fraction(const WoundSeries& series, double fraction) {
  check(series);
  const std::size_t peak = index_of_maximum(series);
  const double target = fraction * series.area[peak];
  if (!(series.area[peak] > 0.0)) return std::nullopt;
  for (std::size_t i = peak; i < series.time.size(); ++i) {
    if (series.area[i] > target) continue;
    if (i == peak) return series.time[peak];
    const double drop = series.area[i - 1] - series.area[i];
    return series.time[i - 1] + (series.area[i - 1] - target) / drop * (series.time[i] - series.time[i - 1]);
  }
  return std::nullopt;
}

ClosureSummary summarise_closure(const WoundSeries& series) {
  check(series);
  const std::size_t peak = index_of_maximum(series);
  ClosureSummary summary;
  summary.maximum_area = series.area[peak];
  summary.time_of_maximum = series.time[peak];
  summary.t_50 = time_to_fraction(series, 0.5);
  summary.t_25 = time_to_fraction(series, 0.25);
  summary.t_10 = time_to_fraction(series, 0.1);
  summary.t_05 = time_to_fraction(series, 0.05);
  if (summary.t_05) summary.closure_rate = 0.95 * summary.maximum_area / (*summary.t_05 - summary.time_of_maximum);
  return summary;
}

WoundSeries mean_series(std::span<const WoundSeries> seeds, std::span<const double> times) {
  if (seeds.empty()) throw InputError("the mean of no wound series was asked for");
  for (const WoundSeries& seed : seeds) check(seed);
  WoundSeries mean;
  for (const double t : times) {
    double sum = 0.0;
    for (const WoundSeries& seed : seeds) sum += value_at(seed, t);
    mean.time.push_back(t);
    mean.area.push_back(sum / static_cast<double>(seeds.size()));
  }
  return mean;
}

}  // namespace suture
