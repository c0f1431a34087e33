// The order at which an error vanishes when a step is halved.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace suture::test {

/// log2 of the ratio of successive errors; errors[k] belongs to step h/2^k. Needs at least two positive errors.
inline std::vector<double> observed_orders(const std::vector<double>& errors) {
  std::vector<double> orders;
  for (std::size_t k = 1; k < errors.size(); ++k) orders.push_back(std::log2(errors[k - 1] / errors[k]));
  return orders;
}

/// Median of the observed orders: one halving spoilt by a kink or by rounding does not decide.
inline double median_order(const std::vector<double>& errors) {
  std::vector<double> orders = observed_orders(errors);
  std::sort(orders.begin(), orders.end());
  return orders.at(orders.size() / 2);
}

}  // namespace suture::test
