// The fields of one frame.
#pragma once

#include "suture/replay/replay.hpp"

namespace suture {

/// stored: the cell fields that the file holds for this frame.
std::vector<Field> compute_fields(const TissueState& state, const Config& config, const Membrane& membrane,
                                  const std::vector<CellField>& stored);

}  // namespace suture
