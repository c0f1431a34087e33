// Two parallel plates that compress a cell from below and above ([P] Fig. 2c).
//
//     U = sum_v e [ (1 - q_top/sigma)^2 + (1 - q_bottom/sigma)^2 ],   each for q < sigma
//     q_top = center_y + gap(t)/2 - y_v,   q_bottom = y_v - center_y + gap(t)/2
//     gap(t) = gap - closing_speed (t - start_time), an explicit function of time
//
// Units: energy epsilon, lengths in sqrt(a0). The law of the circular wall (confinement.hpp) on straight walls; each
// plate keeps acting on vertices that have passed it. Source: model.md section 8; Ton et al. 2023, Fig. 2c.
// C1; the second derivative jumps where q = sigma.
#pragma once

#include "suture/physics/term.hpp"

namespace suture {

struct ParallelPlates {
  double center_y = 0.0;
  double gap = 0.0;     ///< distance between the plates at start_time
  double range = 0.0;   ///< sigma
  double energy = 0.0;  ///< e
  double closing_speed = 0.0;  ///< of the gap; 0: the plates stand still
  double start_time = 0.0;

  double gap_at(double t) const { return gap - closing_speed * (t - start_time); }
};

class Plates final : public EnergyTerm {
 public:
  /// Acts on points 0 .. vertices - 1 (the cell vertices). Throws InputError unless gap and range are positive and
  /// energy is not negative.
  Plates(const ParallelPlates& plates, int vertices);

  std::string_view name() const override { return "plates"; }
  double energy(double t, const StateView& state) const override;
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override;
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override;

 private:
  ParallelPlates plates_;
  int vertices_;
};

}  // namespace suture
