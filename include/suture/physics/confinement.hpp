// Confinement: a circular wall that keeps the cells together while they are packed.
//
//     U = sum_v e_cb (1 - (R - r_v)/sigma)^2   for R - r_v < sigma,   r_v the distance of vertex v from the centre
//
// Units: energy epsilon, lengths in sqrt(a0). The wall keeps acting on vertices that have passed it (r > R).
// Source: model.md section 3. C1; the second derivative jumps at r = R - sigma. A vertex exactly at the centre of a
// circle smaller than sigma has no direction to be pushed in, which is reported.
#pragma once

#include "suture/physics/term.hpp"

namespace suture {

class Confinement final : public EnergyTerm {
 public:
  /// A wall of radius R, range sigma and energy e_cb that acts on points 0 .. vertices - 1 (the cell vertices).
  /// Throws InputError unless radius and range are positive and energy is not negative.
  Confinement(double center_x, double center_y, double radius, double range, double energy, int vertices);

  std::string_view name() const override { return "confinement"; }
  double energy(double t, const StateView& state) const override;
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override;
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override;

 private:
  template <class Visit>
  void for_each_pressed(const StateView& state, Visit&& visit) const;

  double center_x_, center_y_, radius_, range_, energy_;
  int vertices_;
};

}  // namespace suture
