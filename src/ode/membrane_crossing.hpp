// Vertices that a step has carried through the membrane of another cell, where contacts hold them from then on: they push away
// from the nearest membrane on whichever side of it a vertex is.
#pragma once

#include <span>

#include "neighbors/contact_list.hpp"
#include "ode/padded_tissue.hpp"

namespace suture {

/// A vertex that lies inside a cell at `after` (positions, x first) where it did not at `before`; -1: none. Looks at vertices within
/// the contacts' reach of the membrane they have crossed. The list must be valid at `after`.
int vertex_through_membrane(const Tissue& tissue, const PaddedTissue& padded, const ContactList& list, std::span<const double> before,
                            std::span<const double> after);

}  // namespace suture
