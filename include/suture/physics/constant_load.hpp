// A constant force on every point: U = -sum_i f_i . r_i.
//
// Units: energy epsilon, force epsilon/sqrt(a0). Smooth. Used for the extensile force dipole ([S] Fig. S5, model.md
// section 8).
#pragma once

#include <vector>

#include "suture/physics/term.hpp"

namespace suture {

class ConstantLoad final : public EnergyTerm {
 public:
  /// fx, fy: force on points 0, 1, ...; points beyond their length feel none. Throws InputError when their lengths
  /// differ.
  ConstantLoad(std::vector<double> fx, std::vector<double> fy);

  std::string_view name() const override { return "load"; }
  double energy(double t, const StateView& state) const override;
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override;
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override;

 private:
  std::vector<double> fx_, fy_;
};

}  // namespace suture
