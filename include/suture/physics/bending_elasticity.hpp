// Bending elasticity: the membrane resists turning at its vertices.
//
//     U = sum_v k_b/2 theta_v^2,   theta_v = atan2(a x b, a . b),   a = r_v - r_{v-1},   b = r_{v+1} - r_v
//
// Units: energy epsilon, k_b in epsilon, theta in radians, in (-pi, pi]. Source: Ton et al. 2023, Eq. 1.
// Non-smooth where the membrane folds back on itself (theta = pi) and undefined where a segment has length zero, which
// is reported. With phi(e) the polar angle of an edge, theta = phi(b) - phi(a), hence
//     d2U = k_b (grad theta)(grad theta)^T + k_b theta (d2 phi(b) - d2 phi(a)).
#pragma once

#include "suture/physics/term.hpp"

namespace suture {

class BendingElasticity final : public EnergyTerm {
 public:
  /// Reads bending_stiffness of every cell.
  explicit BendingElasticity(const Tissue& tissue) : tissue_(tissue) {}

  std::string_view name() const override { return "bending"; }
  /// All three throw NumericalError for a segment of length zero.
  double energy(double t, const StateView& state) const override;
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override;
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override;

 private:
  Tissue tissue_;
};

}  // namespace suture
