// Area elasticity: the cell resists changes of its area.
//
//     U = sum_i k_a/2 (a_i/a0_i - 1)^2,   a_i = 1/2 sum_v (x_v y_{v+1} - x_{v+1} y_v)
//
// Units: energy epsilon, k_a in epsilon, areas in a0. Source: Ton et al. 2023, Eq. 1. Smooth everywhere.
// The area is a quadratic form, so its second derivative is constant and
//     d2U = k_a/a0^2 (grad a)(grad a)^T + k_a/a0 (a/a0 - 1) d2a.
#pragma once

#include "suture/physics/term.hpp"

namespace suture {

class AreaElasticity final : public EnergyTerm {
 public:
  /// Reads rest_area and area_stiffness of every cell.
  explicit AreaElasticity(const Tissue& tissue) : tissue_(tissue) {}

  std::string_view name() const override { return "area"; }
  double energy(double t, const StateView& state) const override;
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override;
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override;

 private:
  Tissue tissue_;
};

}  // namespace suture
