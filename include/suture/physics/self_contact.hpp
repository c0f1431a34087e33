// Self-contact: two vertices of one cell that are not neighbours along its membrane repel each other.
//
//     U = sum over cells, over pairs of non-adjacent vertices, of e (1 - d/s)^2 for d < s
//
// Units: energy epsilon, d and s in sqrt(a0); e and s are those of the contact between cells. It keeps a membrane from
// crossing itself. Source: the published simulations of Ton et al. 2023; model.md section 3.
// C1 wherever d > 0 (d = 0 is reported); the second derivative jumps at d = s.
#pragma once

#include "suture/physics/contact_law.hpp"
#include "suture/physics/term.hpp"

namespace suture {

class SelfContact final : public EnergyTerm {
 public:
  /// Reads energy and distance; adhesion never acts within a cell. Throws InputError.
  SelfContact(const Tissue& tissue, const ContactParameters& parameters);

  std::string_view name() const override { return "self_contact"; }
  /// All three throw NumericalError naming cell and vertex when two vertices coincide.
  double energy(double t, const StateView& state) const override;
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override;
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override;

 private:
  Tissue tissue_;
  ContactLaw law_;
};

}  // namespace suture
