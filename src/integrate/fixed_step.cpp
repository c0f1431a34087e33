#include <cmath>

#include "integrate/explicit_integrator.hpp"
#include "integrate/rivals.hpp"

namespace suture {

namespace {

/// Steps of one size; the step before a limit is shortened to end there.
class FixedStep : public ExplicitIntegrator {
 public:
  using ExplicitIntegrator::ExplicitIntegrator;
  double step(double limit) final {
    if (!(limit > time_)) return time_;
    double h = options_.time_step;
    const bool last = time_ + h * (1.0 + 1e-9) >= limit;
    if (last) h = limit - time_;
    advance(h);
    evaluate_or_fail(time_ + h, y_next_, f_next_);
    finish(h);
    accept(h);
    if (last) time_ = limit;
    return time_;
  }

 protected:
  /// Fills y_next_ from y_, f_.
  virtual void advance(double h) = 0;
  /// Called with f_next_ = f(y_next_), before the step is accepted.
  virtual void finish(double) {}
};

class Euler final : public FixedStep {
 public:
  Euler(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y)
      : FixedStep(system, options, t, y, 1) {}

 private:
  void advance(double h) override {
    for (std::size_t k = 0; k < y_.size(); ++k) y_next_[k] = y_[k] + h * f_[k];
  }
};

/// "Modified velocity Verlet" of Ton et al. 2023, in the form of their program before it went over to Euler's method
/// (tandrewton/dpm, epi2D::dampedNP0: unit mass and damping, the acceleration corrected for the drag at the new time).
/// The rest lengths, which have no inertia, follow the two-step Adams-Bashforth formula, so the whole is of order 2.
/// f_ holds velocities in its position part, hence output between steps is of the same order.
class Verlet final : public FixedStep {
 public:
  Verlet(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y)
      : FixedStep(system, options, t, y, 2), acceleration_(system.position_count()) {}
  void resume(double t, std::span<const double> y, std::span<const int> source) override;

 private:
  void advance(double h) override {
    const std::size_t n = acceleration_.size();
    for (std::size_t k = 0; k < n; ++k) y_next_[k] = y_[k] + h * (f_[k] + 0.5 * h * acceleration_[k]);
    const double slope = last_step_ > 0.0 ? 0.5 * h * h / last_step_ : 0.0;  // first step: Euler
    for (std::size_t k = n; k < y_.size(); ++k) y_next_[k] = y_[k] + h * f_[k] + slope * (f_[k] - f_before_[k]);
  }
  void finish(double h) override {
    const double mass = options_.vertex_mass;
    for (std::size_t k = 0; k < acceleration_.size(); ++k) {
      const double half_way = f_[k] + 0.5 * h * acceleration_[k];
      acceleration_[k] = (f_next_[k] - half_way) / (mass + 0.5 * h);
      f_next_[k] = half_way + 0.5 * h * acceleration_[k];
    }
  }
  std::vector<double> acceleration_;  // starts at rest relative to the overdamped motion
};

/// Inertia outlives an event: velocities are interpolated to its time and carried over, and the forces that the event has
/// changed accelerate from there.
void Verlet::resume(double t, std::span<const double> y, std::span<const int> source) {
  const double part = last_step_ > 0.0 ? (time_ - t) / last_step_ : 0.0;
  std::vector<double> velocity(acceleration_.size());
  for (std::size_t k = 0; k < velocity.size(); ++k) velocity[k] = f_[k] + part * (f_before_[k] - f_[k]);
  ExplicitIntegrator::resume(t, y, source);
  acceleration_.resize(static_cast<std::size_t>(system_->position_count()));
  for (std::size_t k = 0; k < acceleration_.size(); ++k) {
    const double kept = velocity[source.empty() ? k : static_cast<std::size_t>(source[k])];
    acceleration_[k] = (f_[k] - kept) / options_.vertex_mass;
    f_[k] = kept;
  }
}

class RungeKutta4 final : public FixedStep {
 public:
  RungeKutta4(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y)
      : FixedStep(system, options, t, y, 4), stage_(y.size()), stage_rate_(y.size()) {}

 private:
  void advance(double h) override {
    const double part[3] = {0.5, 0.5, 1.0}, weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    for (std::size_t k = 0; k < y_.size(); ++k) y_next_[k] = y_[k] + weight[0] * h * f_[k];
    const std::vector<double>* rate = &f_;
    for (int j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < y_.size(); ++k) stage_[k] = y_[k] + part[j] * h * (*rate)[k];
      evaluate_or_fail(time_ + part[j] * h, stage_, stage_rate_);
      rate = &stage_rate_;
      for (std::size_t k = 0; k < y_.size(); ++k) y_next_[k] += weight[j + 1] * h * stage_rate_[k];
    }
  }
  void resize(std::size_t n) override {
    stage_.resize(n);
    stage_rate_.resize(n);
  }
  std::vector<double> stage_, stage_rate_;
};

}  // namespace

std::unique_ptr<Integrator> make_euler(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y) {
  return std::make_unique<Euler>(system, options, t, y);
}

std::unique_ptr<Integrator> make_verlet(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y) {
  return std::make_unique<Verlet>(system, options, t, y);
}

std::unique_ptr<Integrator> make_rk4(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y) {
  return std::make_unique<RungeKutta4>(system, options, t, y);
}

}  // namespace suture
