// Membrane elasticity: every segment is a spring of length l and current rest length l0.
//
//     relative:   U = sum k_l/2 (l/l0 - 1)^2          strain relative to the current rest length
//     quadratic:  U = sum k_l/2 ((l - l0)/l0(0))^2    constant spring constant k_l/l0(0)^2
//
// The published simulations use the first, the printed equation is the second.
// Units: energy epsilon, k_l in epsilon, lengths in sqrt(a0). Source: Ton et al. 2023, Eq. 1; model.md
// section 3. Smooth except at l = 0, which is reported. Derivatives are with respect to positions at fixed l0.
#pragma once

#include "suture/physics/term.hpp"

namespace suture {

/// U, dU/dl and d2U/dl2 of one spring.
struct SpringResponse {
  double energy = 0.0, tension = 0.0, stiffness = 0.0;
};

/// initial_rest_length: l0(0), read by the quadratic law only. All lengths positive.
SpringResponse spring_response(SpringLaw law, double stiffness, double length, double rest_length,
                               double initial_rest_length);

class MembraneElasticity final : public EnergyTerm {
 public:
  /// Reads membrane_stiffness of every cell and l0(0) of every segment.
  MembraneElasticity(const Tissue& tissue, SpringLaw law) : tissue_(tissue), law_(law) {}

  std::string_view name() const override { return "membrane"; }
  /// All three throw NumericalError for a segment of length or rest length zero.
  double energy(double t, const StateView& state) const override;
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override;
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override;

 private:
  struct Spring;
  Spring spring(int segment, const StateView& state) const;

  Tissue tissue_;
  SpringLaw law_;
};

}  // namespace suture
