// The chain of the purse string: P springs joining its vertices into a closed ring (Ton et al. 2023, Eq. 7).
//
//     U = sum_j  k_ps/2 (l_j/lambda0_j(t) - 1)^2                        SpringLaw::relative
//     U = sum_j  k_ps/2 ((l_j - lambda0_j(t))/reference_length_j)^2     SpringLaw::quadratic
//
// l_j = |r_(j+1) - r_j| of purse-string vertices j and j+1 (cyclic), lambda0_j(t) = PurseString::rest_length(j, t).
// State read: x, y of the points V .. V+P-1. In time the energy has a kink where lambda0 reaches its floor
// (PurseString::kink_time); in space it is smooth, except at l = 0 with lambda0 > 0. There the energy has a conical
// maximum without a direction: gradient and Hessian take the direction as zero, so they stay finite. With lambda0 = 0
// the quadratic spring is smooth everywhere.
#pragma once

#include <vector>

#include "suture/physics/term.hpp"

namespace suture {

class PurseStringChain final : public EnergyTerm {
 public:
  /// Copies what it needs; rebuild the term after every event that changes the ring.
  /// Reads parameters.law and .stiffness (k_ps, energy). Throws InputError when the law is `relative` and the ring's
  /// minimum rest length is not positive (the stiffness k_ps/lambda0^2 would become infinite), or when the law is
  /// `quadratic` and a reference length is not positive.
  PurseStringChain(const Tissue& tissue, const PurseString& purse_string, const PurseStringParameters& parameters);

  std::string_view name() const override { return "purse_string_chain"; }
  double energy(double t, const StateView& state) const override;
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override;
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override;

  /// dU/dl of every spring at time t (length P, units energy/length); positive when the spring pulls.
  std::vector<double> tensions(double t, const StateView& state) const;

 private:
  struct Spring {
    int from = 0, to = 0;  // point indices
    double dx = 0.0, dy = 0.0, length = 0.0, rest_length = 0.0;
    double stiffness = 0.0;  // d2U/dl2
  };
  Spring spring(int j, double t, const StateView& state) const;

  PurseString purse_string_;
  std::vector<double> spring_stiffness_;  // of the quadratic law: constant
  SpringLaw law_;
  double stiffness_;
  int first_point_;
};

}  // namespace suture
