#include "support/derivative_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "support/convergence_order.hpp"
#include "support/random_tissue.hpp"
#include "suture/physics/term_sum.hpp"

namespace suture::test {

namespace {

constexpr double largest_step = 1.6e-5;
constexpr int halvings = 4;

using Values = std::vector<double>;

Values moved(const TissueState& state, const Values& direction, double step) {
  Values values = state.values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += step * direction[i];
  return values;
}

double energy_at(const EnergyTerm& term, const TissueState& state, const Values& values) {
  return term.energy(state.time, StateView(state.layout(), values));
}

Values gradient_at(const EnergyTerm& term, const TissueState& state, const Values& values) {
  Values gradient(values.size(), 0.0);
  term.add_gradient(state.time, StateView(state.layout(), values), MutableStateView(state.layout(), gradient));
  return gradient;
}

Values product_at(const EnergyTerm& term, const TissueState& state, const Values& v) {
  Values out(v.size(), 0.0);
  const StateView direction(state.layout(), v);
  const MutableStateView view(state.layout(), out);
  add_hessian_product(term, state.time, state.view(), direction.x, direction.y, view.x, view.y);
  return out;
}

double largest(const Values& values) {
  return std::accumulate(values.begin(), values.end(), 0.0,
                         [](double m, double v) { return std::max(m, std::abs(v)); });
}

/// Order of a sequence of remainders; those at the level of rounding carry none and count as exact.
double order_of(const Values& remainders, double rounding) {
  if (!std::all_of(remainders.begin(), remainders.end(), [](double r) { return std::isfinite(r); })) return 0.0;
  return *std::min_element(remainders.begin(), remainders.end()) <= rounding ? 2.0 : median_order(remainders);
}

/// Remainders of energy and gradient along v at steps h, h/2, ...
struct Remainders {
  Values energy, gradient;
};

Remainders remainders(const EnergyTerm& term, const TissueState& state, const Values& v, std::string& worst) {
  const double energy = energy_at(term, state, state.values);
  const Values gradient = gradient_at(term, state, state.values), product = product_at(term, state, v);
  const double slope = std::inner_product(gradient.begin(), gradient.end(), v.begin(), 0.0);
  Remainders result;
  double step = largest_step;
  for (int k = 0; k <= halvings; ++k, step *= 0.5) {
    const Values values = moved(state, v, step), change = gradient_at(term, state, values);
    result.energy.push_back(std::abs(energy_at(term, state, values) - energy - step * slope));
    result.gradient.push_back(0.0);
    for (int i = 0; i < state.layout().positions(); ++i) {
      const double remainder = std::abs(change[i] - gradient[i] - step * product[i]);
      if (remainder <= result.gradient.back()) continue;
      result.gradient.back() = remainder;
      worst = fmt::format("component {}: Hessian product {}, difference quotient {}, step {}", i, product[i],
                          (change[i] - gradient[i]) / step, step);
    }
  }
  return result;
}

void check_matrix(const EnergyTerm& term, const TissueState& state, const Values& v, DerivativeReport& report) {
  // The term outlives the list: nothing is owned.
  const TermList only{std::shared_ptr<const EnergyTerm>(std::shared_ptr<const EnergyTerm>{}, &term)};
  const Eigen::SparseMatrix<double> hessian = assemble_hessian(only, state.time, state.view());
  const Eigen::VectorXd assembled = hessian * Eigen::Map<const Eigen::VectorXd>(v.data(), hessian.cols());
  const Values product = product_at(term, state, v);
  const Eigen::SparseMatrix<double> transposed = hessian.transpose();
  const double scale =
      std::max(hessian.coeffs().size() ? hessian.coeffs().abs().maxCoeff() : 0.0, std::numeric_limits<double>::min());
  const Eigen::SparseMatrix<double> skew = hessian - transposed;
  if (skew.coeffs().size()) report.asymmetry = std::max(report.asymmetry, skew.coeffs().abs().maxCoeff() / scale);
  for (int i = 0; i < assembled.size(); ++i)
    report.product_error = std::max(report.product_error, std::abs(assembled[i] - product[i]) / scale);
}

}  // namespace

bool DerivativeReport::passed() const {
  return checked > 0 && gradient_order > 1.8 && hessian_order > 1.8 && asymmetry < 1e-12 && product_error < 1e-11;
}

std::string DerivativeReport::text() const {
  return fmt::format(
      "{} directions; order of energy remainder {:.2f}, of gradient remainder {:.2f}; asymmetry {:.1e}, product "
      "{:.1e}; {}",
      checked, gradient_order, hessian_order, asymmetry, product_error, worst);
}

DerivativeReport check_derivatives(const EnergyTerm& term, const TissueState& state, std::uint64_t seed,
                                   int directions) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  DerivativeReport report;
  const double energy_scale = std::abs(energy_at(term, state, state.values)) + 1.0;
  const double gradient_scale = largest(gradient_at(term, state, state.values)) + 1.0;
  for (int k = 0; k < directions; ++k) {
    const Values v = random_direction(state, seed + k);
    std::string worst;
    const Remainders r = remainders(term, state, v, worst);
    const double gradient_order = order_of(r.energy, 20.0 * epsilon * energy_scale);
    const double hessian_order = order_of(r.gradient, 20.0 * epsilon * gradient_scale);
    if (hessian_order < report.hessian_order || report.worst.empty()) report.worst = worst;
    report.gradient_order = std::min(report.gradient_order, gradient_order);
    report.hessian_order = std::min(report.hessian_order, hessian_order);
    check_matrix(term, state, v, report);
    if (gradient_scale > 1.0) ++report.checked;
  }
  return report;
}

}  // namespace suture::test
