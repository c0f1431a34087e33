// A small tissue with a wound and a purse string, for tests of output: nothing in it is in equilibrium.
#pragma once

#include "suture/model/state.hpp"

namespace suture::test {

/// Round cells on a hexagonal lattice of `rings` rings about a missing central cell, counter-clockwise, with a purse
/// string on the inner circle. Cells differ in vertex number and material, every number is irrational-looking, and
/// one cell is elastic (tau infinite).
TissueState sample_tissue(int rings = 2);

}  // namespace suture::test
