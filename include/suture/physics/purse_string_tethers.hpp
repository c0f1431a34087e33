// The tethers that hold the purse string on the wound edge: vertex j of the ring to its cell vertex (Ton et al. 2023,
// Eq. 6). With d the stretch vector from cell vertex to purse-string vertex, l = |d|, h = l_y/2 and stiffness k_p,
// the force and the energy are, continuous wherever the law is,
//
//     saturating_force    f = k_p min(l, h)                U = k_p l^2/2 (l < h),  k_p h (l - h/2) beyond
//     saturating_energy   f = k_p l  while attached        U = k_p l^2/2    the same formula beyond h: the mode, not
//                         f = 0      once slipped          U = k_p h^2/2    the length, decides, and only events flip
//                         it
//     ramp                f = k_p l (l < h),               U = k_p l^2/2 (l < h),
//                         k_p (l_y - l) to l_y, then 0     k_p (h^2 - (l_y - l)^2/2) to l_y, then k_p h^2
//     published           f_x = k_p min(d_x, h), f_y alike U = phi(d_x) + phi(d_y), phi as in saturating_force
//
// All but `published` are central forces: invariant under rotation. `published` is what the published simulations
// computed; it depends on the axes and does not saturate in the -x and -y directions. State read: x, y of the points
// V+j and vertex[j]. The second derivative jumps at l = h (saturating_force, ramp), l = l_y (ramp), d_x = h and d_y = h
// (published). Yield at l = l_y is an event (ode/purse_string_events.hpp): the laws go on smoothly past it.
#pragma once

#include <vector>

#include "suture/physics/term.hpp"

namespace suture {

/// Energy, force f = dU/dl and df/dl of one tether of length l >= 0.
struct TetherResponse {
  double energy = 0.0;
  double force = 0.0;
  double slope = 0.0;
};

/// Response of a central tether law. `published` is evaluated as its one-component potential phi(u), u of either sign.
/// stiffness: k_p; yield_length: l_y in model units of length. Only saturating_energy reads the mode.
TetherResponse tether_response(TetherLaw law, TetherMode mode, double stiffness, double yield_length, double l);

class PurseStringTethers final : public EnergyTerm {
 public:
  /// Copies what it needs; rebuild the term after every event that changes the ring or a tether's mode.
  /// Reads parameters.tether_law, .tether_stiffness (k_p, energy/length^2) and .yield_length (in units of
  /// contact_distance). contact_distance: s, model units of length, > 0 (InputError otherwise).
  PurseStringTethers(const Tissue& tissue, const PurseString& purse_string, const PurseStringParameters& parameters,
                     double contact_distance);

  std::string_view name() const override { return "purse_string_tethers"; }
  double energy(double t, const StateView& state) const override;
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override;
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override;

  /// |force| on the cell vertex of every tether (length P).
  std::vector<double> forces(const StateView& state) const;

 private:
  struct Stretch {
    int cell_point = 0, ring_point = 0;
    double dx = 0.0, dy = 0.0;  // from cell vertex to purse-string vertex
  };
  Stretch stretch(int j, const StateView& state) const;
  TetherResponse response(int j, double l) const;
  /// Force (fx, fy) pulling the cell vertex along the stretch.
  std::array<double, 2> pull(int j, const Stretch& d) const;
  /// Second derivative of the tether's energy with respect to the stretch.
  Block curvature(int j, const Stretch& d) const;

  std::vector<int> vertex_;
  std::vector<TetherMode> mode_;
  TetherLaw law_;
  double stiffness_;
  double yield_length_;
  int first_point_;
};

}  // namespace suture
