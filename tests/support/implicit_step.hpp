// One implicit step's linear system, for the tests of its solvers.
#pragma once

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <span>

#include "suture/model/state.hpp"
#include "suture/ode/tissue_ode.hpp"

namespace suture::test {

inline Eigen::VectorXd wave(int n) {
  Eigen::VectorXd v(n);
  for (int k = 0; k < n; ++k) v[k] = std::sin(1.0 + 1.37 * k);
  return v;
}

inline std::span<const double> span(const Eigen::VectorXd& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
inline std::span<double> span(Eigen::VectorXd& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

/// Residual and linearisation at the state's own positions.
inline void linearise(TissueOde& ode, const TissueState& state, double gamma) {
  ode.begin_implicit_step(state.time, gamma, state.values);
  Eigen::VectorXd residual(ode.position_count());
  REQUIRE(ode.residual(std::span(state.values).first(ode.position_count()), span(residual)) == Evaluation::ok);
  ode.linearise();
}

inline Eigen::VectorXd conjugate_gradients(TissueOde& ode, const Eigen::VectorXd& b, int& iterations) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size()), r = b, z = b, p, ap = b;
  ode.precondition(span(r), span(z));
  p = z;
  double rz = r.dot(z);
  for (iterations = 0; iterations < 200 && r.norm() > 1e-13 * b.norm(); ++iterations) {
    ode.product(span(p), span(ap));
    const double step = rz / p.dot(ap);
    x += step * p;
    r -= step * ap;
    ode.precondition(span(r), span(z));
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  return x;
}

inline double relative_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return (a - b).norm() / b.norm(); }

}  // namespace suture::test
