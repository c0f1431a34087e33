#include "suture/replay/colour_range.hpp"

#include <algorithm>
#include <cmath>

namespace suture {
namespace {

constexpr double lowest_share = 0.01, highest_share = 0.99;  // of all values of segments lie within the bar

double at_share(std::vector<double>& values, double fraction) {
  const auto place = values.begin() + std::lround(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

std::pair<double, double> colour_range(std::vector<double> values, Place place) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {0.0, 1.0};
  const bool segments = place == Place::segment;
  double low = at_share(values, segments ? lowest_share : 0.0), high = at_share(values, segments ? highest_share : 1.0);
  const double scale = std::max(std::abs(low), std::abs(high));
  if (!(high - low > 1e-9 * scale)) {  // one value, up to rounding
    const double margin = scale > 0.0 ? 0.05 * scale : 0.05;
    low -= margin, high += margin;
  }
  const double step = std::pow(10.0, std::floor(std::log10(0.5 * (high - low))));
  // Rounding must not push an end that is a round number already to the next one.
  return {step * std::floor(low / step + 1e-9), step * std::ceil(high / step - 1e-9)};
}

}  // namespace suture
