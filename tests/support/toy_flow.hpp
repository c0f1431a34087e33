// Gradient flows with deliberate faults, for the failure paths of the integrators.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "suture/ode/ode_system.hpp"

namespace suture::test {

/// q_k' = -stiffness_k q_k of `size` positions and one rest length that does not move. `fault` is asked at every
/// evaluation, rate or residual, and may refuse it or throw.
class ToyFlow : public GradientFlowSystem {
 public:
  explicit ToyFlow(int size, std::function<Evaluation(std::span<const double> q)> fault = {})
      : size_(size), fault_(std::move(fault)) {}

  int size() const override { return size_ + 1; }
  int position_count() const override { return size_; }
  std::string component_name(int i) const override { return "component " + std::to_string(i); }
  std::string refusal() const override { return refused_ ? "the toy refuses" : ""; }
  double stiffness(std::size_t k) const { return 1.0 + static_cast<double>(k); }
  long evaluations() const { return evaluations_; }

  Evaluation rate(double, std::span<const double> y, std::span<double> out) override {
    for (int k = 0; k < size_; ++k) out[k] = -stiffness(k) * y[k];
    out[size_] = 0.0;
    return ask(y.first(size_));
  }
  void begin_implicit_step(double, double gamma, std::span<const double> psi) override {
    gamma_ = gamma;
    psi_.assign(psi.begin(), psi.end());
  }
  Evaluation residual(std::span<const double> q, std::span<double> f) override {
    for (int k = 0; k < size_; ++k) f[k] = q[k] - psi_[k] + gamma_ * stiffness(k) * q[k];
    return ask(q);
  }
  void linearise() override {}
  void product(std::span<const double> v, std::span<double> out) override {
    for (int k = 0; k < size_; ++k) out[k] = (1.0 + gamma_ * stiffness(k)) * v[k];
  }
  void set_up_preconditioner() override {}
  void precondition(std::span<const double> r, std::span<double> z) override {
    std::copy(r.begin(), r.end(), z.begin());
  }
  void recover_memory(std::span<const double>, std::span<double> memory) override { memory[0] = psi_[size_]; }

 private:
  Evaluation ask(std::span<const double> q) {
    ++evaluations_;
    const Evaluation answer = fault_ ? fault_(q) : Evaluation::ok;
    refused_ = answer != Evaluation::ok;
    return answer;
  }

  int size_;
  std::function<Evaluation(std::span<const double>)> fault_;
  double gamma_ = 0.0;
  std::vector<double> psi_;
  long evaluations_ = 0;
  bool refused_ = false;
};

}  // namespace suture::test
