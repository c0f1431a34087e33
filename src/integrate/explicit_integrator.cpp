#include "integrate/explicit_integrator.hpp"

#include <algorithm>

#include "integrate/failure_report.hpp"

namespace suture {

ExplicitIntegrator::ExplicitIntegrator(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y, int order)
    : system_(&system), operations_(system.workers()), options_(options), order_(order), time_(t), y_(y.begin(), y.end()) {
  for (auto* v : {&f_, &y_before_, &f_before_, &y_next_, &f_next_}) v->resize(y.size());
  evaluate_or_fail(t, y_, f_);
}

Evaluation ExplicitIntegrator::evaluate(double t, std::span<const double> y, std::span<double> out) {
  ++counts_.rate_evaluations;
  return system_->rate(t, y, out);
}

void ExplicitIntegrator::evaluate_or_fail(double t, std::span<const double> y, std::span<double> out) {
  if (evaluate(t, y, out) != Evaluation::ok) fail("the rate cannot be evaluated", last_step_, {});
}

void ExplicitIntegrator::accept(double h) {
  y_before_.swap(y_);
  f_before_.swap(f_);
  y_.swap(y_next_);
  f_.swap(f_next_);
  time_ += h;
  last_step_ = h;
  ++counts_.steps;
  ++counts_.explicit_steps;
}

/// One-step methods have no past to keep: only the state and its rate.
void ExplicitIntegrator::resume(double t, std::span<const double> y, std::span<const int> source) {
  const double s = last_step_ > 0.0 ? (t - (time_ - last_step_)) / last_step_ : 1.0;
  std::vector<double>& before = y_next_;  // rate before the event, in the components after it
  before.resize(y.size());
  for (std::size_t k = 0; k < y.size(); ++k) {
    const std::size_t j = source.empty() ? k : static_cast<std::size_t>(source[k]);
    before[k] = last_step_ > 0.0 ? (1.0 - s) * f_before_[j] + s * f_[j] : f_[j];
  }
  if (y.size() != y_.size()) {
    for (auto* v : {&f_, &y_before_, &f_before_, &f_next_}) v->resize(y.size());
    resize(y.size());
  }
  time_ = t;
  last_step_ = 0.0;
  y_.assign(y.begin(), y.end());
  evaluate_or_fail(t, y_, f_);
  for (std::size_t k = 0; k < y.size(); ++k) before[k] -= f_[k];
  restarted(before);
}

ExplicitIntegrator::Hermite ExplicitIntegrator::hermite(double t) const {
  const double h = last_step_, s = (t - (time_ - h)) / h;
  return {(1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s), s * s * (3.0 - 2.0 * s), h * s * (1.0 - s) * (1.0 - s), -h * s * s * (1.0 - s)};
}

void ExplicitIntegrator::interpolate(double t, std::span<double> y) const {
  if (last_step_ == 0.0) {
    std::copy(y_.begin(), y_.end(), y.begin());
    return;
  }
  const Hermite w = hermite(t);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = value(w, k);
}

void ExplicitIntegrator::interpolate_some(double t, std::span<const int> components, std::span<double> y) const {
  if (last_step_ == 0.0) {
    for (const int k : components) y[k] = y_[k];
    return;
  }
  const Hermite w = hermite(t);
  for (const int k : components) y[k] = value(w, static_cast<std::size_t>(k));
}

void ExplicitIntegrator::fail(const std::string& what, double h, std::span<const double> errors) const {
  throw NumericalError(failure_report(*system_, what, time_, h, order_, worst_components(*system_, errors, options_)));
}

}  // namespace suture
