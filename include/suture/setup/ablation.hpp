// Stage 3 of the protocol: cells in the middle of the tissue are removed (model.md section 6).
#pragma once

#include <vector>

#include "suture/model/state.hpp"

namespace suture {

/// The `count` cells whose centroids are nearest the tissue centre (the mean of all centroids weighted by cell area),
/// nearest first; equal distances in order of cell number.
std::vector<int> central_cells(const TissueState& state, int count);

/// The same state without the given cells. Throws InputError when none would be left, when a cell does not exist or is
/// named twice, or when the state has a purse string.
TissueState remove_cells(const TissueState& state, const std::vector<int>& cells);

}  // namespace suture
