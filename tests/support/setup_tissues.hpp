// Small tissues for the tests of the protocol: prepared in a fraction of a second.
#pragma once

#include "suture/model/parameters.hpp"
#include "suture/setup/dynamics.hpp"
#include "suture/setup/packing.hpp"

namespace suture::test {

/// Seven cells of 16 vertices, wounded by one cell; neither holes nor the size of the wound are judged.
Config small_config();

/// The packing of small_config(), computed once.
const Packing& packed_small_tissue();

/// Makes the tissue of `config` without plasticity, wall or purse string.
MakeOde elastic_forces(const Config& config, const Tissue& tissue);

}  // namespace suture::test
