// The contact potential of a distance d between two membrane centre lines.
//
//     u(d) = e [ (1 - d/s)^2 - l1 l2 ]                       0 <= d/s < 1 + l1     repulsion turning into adhesion
//     u(d) = -e l1/(l2 - l1) (1 + l2 - d/s)^2           1 + l1 <= d/s < 1 + l2     the adhesive tail
//     u(d) = 0                                                otherwise
//
// Units: energy epsilon; d, s in sqrt(a0); l1, l2 in units of s. l1 = 0 is pure repulsion: the tail vanishes.
// Source: the pair potential of Ton et al. 2023 (supplement, Fig. S1), with prefactor and range as in the published
// simulations (model.md sections 3 and 9).
// u is C1; its second derivative jumps at d = s (1 + l1) and d = s (1 + l2) (at d = s when l1 = 0).
#pragma once

#include "suture/model/tissue.hpp"

namespace suture {

class ContactLaw {
 public:
  /// Throws InputError unless energy >= 0, distance > 0 and 0 = adhesion, 0 <= range or 0 < adhesion < range.
  ContactLaw(double energy, double distance, double adhesion, double range);

  double value(double d) const;
  double first_derivative(double d) const;   ///< du/dd: minus the repulsive force
  double second_derivative(double d) const;  ///< at a jump: the value on its far side

  /// u vanishes from here on.
  double reach() const { return adhesion_ > 0.0 ? outer_ : distance_; }

  double energy() const { return energy_; }
  double distance() const { return distance_; }
  double adhesion() const { return adhesion_; }
  double range() const { return range_; }

 private:
  double energy_, distance_, adhesion_, range_;
  double inner_, outer_;  ///< s (1 + l1), s (1 + l2)
  double tail_ = 0.0;     ///< e l1/(l2 - l1)
};

/// The law of [contact]; an unset contact distance is the tissue's mean initial rest length. Throws InputError.
ContactLaw make_contact_law(const Tissue& tissue, const ContactParameters& parameters);

}  // namespace suture
