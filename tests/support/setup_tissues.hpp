// Small tissues for the tests of the protocol: prepared in a fraction of a second.
#pragma once

#include "suture/model/parameters.hpp"
#include "suture/model/state.hpp"
#include "suture/setup/dynamics.hpp"
#include "suture/setup/packing.hpp"

namespace suture::test {

/// Seven cells of 16 vertices, wounded by one cell; neither holes nor the size of the wound are judged.
Config small_config();

/// The packing of small_config(), computed once.
const Packing& packed_small_tissue();

/// small_config() closing its wound by `method`, with a membrane that yields quickly.
Config small_closing_config(Method method);

/// The wounded tissue of small_config(), prepared once, with the materials of `config`.
TissueState small_wound(const Config& config);

/// Makes the tissue of `config` without plasticity, wall or purse string.
MakeOde elastic_forces(const Config& config, const Tissue& tissue);

}  // namespace suture::test
