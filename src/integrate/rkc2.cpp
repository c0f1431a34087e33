// Runge-Kutta-Chebyshev of order 2: stability interval about 0.65 s^2 along the negative real axis with s stages, which
// suits a gradient flow. Sommeijer, Shampine and Verwer, J. Comput. Appl. Math. 88 (1998) 315.
#include <algorithm>
#include <cmath>

#include "integrate/explicit_integrator.hpp"
#include "integrate/rivals.hpp"
#include "integrate/step_control.hpp"

namespace suture {

namespace {

class Rkc2 final : public ExplicitIntegrator {
 public:
  Rkc2(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y)
      : ExplicitIntegrator(system, options, t, y, 2), direction_(f_), stage_a_(y.size()), stage_b_(y.size()), stage_f_(y.size()), errors_(y.size()) {
    control_.start(options.initial_step);
  }

  double step(double limit) override;
  bool stops_cheaply() const override { return true; }

 private:
  void resize(std::size_t n) override {
    for (auto* v : {&direction_, &stage_a_, &stage_b_, &stage_f_, &errors_}) v->resize(n);
  }
  void restarted(std::span<const double> jump) override { control_.restart(norm(jump)); }
  bool attempt(double h);
  void estimate_spectral_radius();
  double first_step();
  /// Fills y_next_; false when a stage was refused.
  bool stages(double h, int s);
  double error_norm(double h);
  double norm(std::span<const double> v) const;

  std::vector<double> direction_, stage_a_, stage_b_, stage_f_, errors_;  // errors_: of the last completed attempt
  double radius_ = 0.0;
  StepControl control_;
  int steps_since_radius_ = 0;
};

double Rkc2::norm(std::span<const double> v) const {
  const std::size_t n = system_->position_count();
  const double positions = square_sum(v.first(n)), rest = square_sum(v.subspan(n));
  const double p = options_.position_tolerance, r = options_.rest_length_tolerance;
  return std::sqrt((positions / (p * p) + rest / (r * r)) / static_cast<double>(v.size()));
}

/// Nonlinear power iteration, started from the previous eigenvector.
void Rkc2::estimate_spectral_radius() {
  const auto length = [this](const std::vector<double>& v) { return std::sqrt(square_sum(v)); };
  const double scale = std::sqrt(static_cast<double>(y_.size())) * 1e-3 * options_.position_tolerance;
  double size = length(direction_);
  if (!(size > 0.0)) {
    for (std::size_t k = 0; k < direction_.size(); ++k) direction_[k] = (k % 2 == 0) ? 1.0 : -1.0;
    size = length(direction_);
  }
  double estimate = 0.0;
  for (int iteration = 0; iteration < 50; ++iteration) {
    fill(stage_a_, [=, this](std::size_t k) { return y_[k] + scale / size * direction_[k]; });
    if (evaluate(time_, stage_a_, stage_f_) != Evaluation::ok) break;
    fill(direction_, [=, this](std::size_t k) { return stage_f_[k] - f_[k]; });
    size = length(direction_);
    const double before = estimate;
    estimate = size / scale;
    if (iteration >= 1 && std::abs(estimate - before) <= 0.01 * estimate) break;
    if (!(size > 0.0)) break;
  }
  radius_ = 1.2 * std::max(estimate, 1e-6);
  steps_since_radius_ = 0;
}

double Rkc2::first_step() {
  double h = std::min(1.0 / radius_, options_.maximum_step > 0.0 ? options_.maximum_step : 1e300);
  fill(stage_a_, [=, this](std::size_t k) { return y_[k] + h * f_[k]; });
  if (evaluate(time_ + h, stage_a_, stage_f_) != Evaluation::ok) return 0.1 * h;
  fill(stage_f_, [=, this](std::size_t k) { return h * (stage_f_[k] - f_[k]); });
  const double error = norm(stage_f_);
  return error > 0.01 ? 0.1 * h / std::sqrt(error) : h;
}

bool Rkc2::stages(double h, int s) {
  const double w0 = 1.0 + 2.0 / (13.0 * s * s);
  // Chebyshev polynomials T_j(w0) and their first two derivatives, by recurrence.
  double t0 = 1.0, t1 = w0, d0 = 0.0, d1 = 1.0, dd0 = 0.0, dd1 = 0.0;
  {
    double a = 1.0, b = w0, da = 0.0, db = 1.0, dda = 0.0, ddb = 0.0;
    for (int j = 2; j <= s; ++j) {
      const double c = 2.0 * w0 * b - a, dc = 2.0 * b + 2.0 * w0 * db - da, ddc = 4.0 * db + 2.0 * w0 * ddb - dda;
      a = b, b = c, da = db, db = dc, dda = ddb, ddb = ddc;
    }
    t0 = db, t1 = ddb;  // T's(w0), T''s(w0)
  }
  const double w1 = t0 / t1;
  const double b2 = 4.0 / std::pow(4.0 * w0, 2);  // T''_2/(T'_2)^2
  double bj2 = b2, bj1 = b2;
  t0 = 1.0, t1 = w0;
  double mu1 = bj1 * w1;
  std::vector<double>*previous = &stage_a_, *current = &stage_b_;  // Y_{j-2}, Y_{j-1}
  *previous = y_;
  combine<2>(*current, {1.0, mu1 * h}, {y_.data(), f_.data()});
  double c_previous = 0.0, c_current = mu1;
  for (int j = 2; j <= s; ++j) {
    const double t2 = 2.0 * w0 * t1 - t0, d2 = 2.0 * t1 + 2.0 * w0 * d1 - d0, dd2 = 4.0 * d1 + 2.0 * w0 * dd1 - dd0;
    const double bj = dd2 / (d2 * d2);
    const double mu = 2.0 * bj * w0 / bj1, nu = -bj / bj2, mut = 2.0 * bj * w1 / bj1;
    const double gammat = -(1.0 - bj1 * t1) * mut;
    if (evaluate(time_ + c_current * h, *current, stage_f_) != Evaluation::ok) return false;
    std::vector<double>& out = j == s ? y_next_ : *previous;
    combine<5>(out, {1.0 - mu - nu, mu, nu, h * mut, h * gammat}, {y_.data(), current->data(), previous->data(), stage_f_.data(), f_.data()});
    const double c_next = mu * c_current + nu * c_previous + mut + gammat;
    c_previous = c_current, c_current = c_next;
    std::swap(previous, current);
    t0 = t1, t1 = t2, d0 = d1, d1 = d2, dd0 = dd1, dd1 = dd2;
    bj2 = bj1, bj1 = bj;
  }
  return true;
}

double Rkc2::error_norm(double h) {
  combine<4>(errors_, {0.8, -0.8, 0.4 * h, 0.4 * h}, {y_.data(), y_next_.data(), f_.data(), f_next_.data()});
  return norm(errors_);
}

/// Stages for a step h, and the rate at its end.
bool Rkc2::attempt(double h) {
  const int s = std::max(2, 1 + static_cast<int>(std::sqrt(1.54 * h * radius_ + 1.0)));
  return stages(h, s) && evaluate(time_ + h, y_next_, f_next_) == Evaluation::ok;
}

double Rkc2::step(double limit) {
  if (!(limit > time_)) return time_;
  if (radius_ == 0.0 || steps_since_radius_ >= 25) estimate_spectral_radius();
  if (control_.step() == 0.0) control_.start(first_step());
  bool refused = false;
  for (int tries = 0; tries < 60; ++tries) {
    double h = control_.step();
    if (options_.maximum_step > 0.0) h = std::min(h, options_.maximum_step);
    const bool last = time_ + h * 1.01 >= limit;
    if (last) h = limit - time_;
    if (!last && time_ + 2.0 * h > limit) h = 0.5 * (limit - time_);  // two equal steps rather than one and a remainder
    refused = !attempt(h);
    const double error = refused ? 0.0 : error_norm(h);
    if (!refused && error <= 1.0) refused = system_->jumps(y_, y_next_);
    if (!refused && error <= 1.0) {
      control_.next(h, error, h < control_.step());
      ++steps_since_radius_;
      accept(h);
      if (last) time_ = limit;
      return time_;
    }
    ++(refused ? counts_.convergence_failures : counts_.error_test_failures);
    const double next = refused ? control_.retry_refused(h) : control_.retry(h, error);
    if (time_ + next == time_) break;
    // Behind an event one failure is likely to be what the event set off; others may be a radius that has grown.
    if (steps_since_radius_ > 0 && (tries > 0 || last_step_ > 0.0)) estimate_spectral_radius();
  }
  fail(refused ? "the rate cannot be evaluated" : "the error test failed repeatedly", control_.step(), errors_);
}

}  // namespace

std::unique_ptr<Integrator> make_rkc2(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y) {
  return std::make_unique<Rkc2>(system, options, t, y);
}

}  // namespace suture
