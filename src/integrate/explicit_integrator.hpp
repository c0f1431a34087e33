// What the explicit methods share: state and rate at both ends of the last step, and cubic Hermite output between.
#pragma once

#include <array>
#include <vector>

#include "integrate/vector_operations.hpp"
#include "suture/errors.hpp"
#include "suture/integrate/integrator.hpp"

namespace suture {

class ExplicitIntegrator : public Integrator {
 public:
  /// Throws NumericalError when the rate is refused at the start.
  ExplicitIntegrator(OdeSystem& system, const IntegratorOptions& options, double t, std::span<const double> y, int order);

  double time() const override { return time_; }
  std::span<const double> state() const override { return y_; }
  double last_step() const override { return last_step_; }
  int last_order() const override { return order_; }
  /// Cubic Hermite between the ends of the last step.
  void interpolate(double t, std::span<double> y) const override;
  void interpolate_some(double t, std::span<const int> components, std::span<double> y) const override;
  Statistics statistics() const override { return counts_; }
  void resume(double t, std::span<const double> y, std::span<const int> source) override;

 protected:
  /// Throws NumericalError when the rate is refused; explicit fixed-step methods cannot retry.
  void evaluate_or_fail(double t, std::span<const double> y, std::span<double> out);
  Evaluation evaluate(double t, std::span<const double> y, std::span<double> out);
  /// Accepts y_next_ (and its rate f_next_) as the state at time() + h.
  void accept(double h);
  /// For methods with vectors of their own: the system has this many components from now on.
  virtual void resize(std::size_t) {}
  /// After an event that changed the rate by this.
  virtual void restarted(std::span<const double> /*jump*/) {}
  [[noreturn]] void fail(const std::string& what, double h, std::span<const double> errors) const;

  /// out[k] = value(k) for every component. Numbers are captured by value: then the loop can keep them in registers.
  template <class Value>
  void fill(std::vector<double>& out, const Value& value) const {
    operations_.for_each_range(out.size(), [&](Range r) {
      const Value own = value;
      for (std::size_t k = r.begin; k < r.end; ++k) out[k] = own(k);
    });
  }
  double square_sum(std::span<const double> v) const { return operations_.dot(v.size(), v.data(), v.data()); }
  /// out = the sum of coefficient * vector over all pairs.
  template <std::size_t count>
  void combine(std::vector<double>& out, const std::array<double, count>& coefficients, const std::array<const double*, count>& vectors) const {
    operations_.linear_combination(out.size(), count, coefficients.data(), vectors.data(), out.data());
  }

  struct Hermite {
    double before, after, rate_before, rate_after;  // weights of the state and the rate at the ends of the last step
  };
  Hermite hermite(double t) const;
  double value(const Hermite& w, std::size_t k) const {
    return w.before * y_before_[k] + w.after * y_[k] + w.rate_before * f_before_[k] + w.rate_after * f_[k];
  }

  OdeSystem* system_;
  VectorOperations operations_;
  IntegratorOptions options_;
  int order_;
  double time_, last_step_ = 0.0;
  std::vector<double> y_, f_, y_before_, f_before_, y_next_, f_next_;
  Statistics counts_;
};

}  // namespace suture
