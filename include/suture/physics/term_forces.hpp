// The force and energy of every term of the cells on one configuration: what `suture forces` prints.
#pragma once

#include <string>
#include <vector>

#include "suture/model/state.hpp"

namespace suture {

/// One term evaluated alone.
struct TermForces {
  std::string term;
  double energy = 0.0;         ///< in epsilon
  std::vector<double> fx, fy;  ///< -dU/dr of every point, in epsilon/sqrt(a0)
};

/// Area, membrane, bending and contact (with self-contact unless contact.self_contact is off), in this order.
/// Stiffnesses come from the tissue's materials, the membrane law and the contact law from config. Throws InputError
/// for an inconsistent contact law, NumericalError for zero lengths and distances.
std::vector<TermForces> evaluate_forces(const TissueState& state, const Config& config);

}  // namespace suture
