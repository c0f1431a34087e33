// How wide a membrane is: the lengths every measure of free space is built from (model.md sections 3 and 7).
#pragma once

#include "suture/model/tissue.hpp"

namespace suture {

/// Membranes touch at centre-line distance s and feel each other up to s(1 + l2).
struct Membrane {
  double contact_distance = 0.0;  ///< s, model units of length
  double range = 0.0;             ///< l2, in units of s

  /// s/2: free space begins here, beyond the vertex discs of the published area count.
  double half_width() const { return 0.5 * contact_distance; }
  /// rho = s(1 + l2)/2: the largest disc that cannot enter a crack between cells in contact.
  double probe_radius() const { return 0.5 * interaction_distance(); }
  /// s(1 + l2): cells at least this close are in contact.
  double interaction_distance() const { return contact_distance * (1.0 + range); }
};

/// The membrane of a contact law; an unset contact distance means the mean initial rest length l0(0).
/// Throws InputError unless s > 0 and l2 >= 0.
Membrane make_membrane(const ContactParameters& contact, const Tissue& tissue);

}  // namespace suture
