// Stage 3 of the protocol: cells in the middle of the tissue are removed and the wound relaxes (model.md section 6).
#pragma once

#include <vector>

#include "suture/setup/dynamics.hpp"
#include "suture/setup/progress.hpp"

namespace suture {

/// The `count` cells whose centres of area are nearest that of the whole tissue, nearest first; equal distances in
/// order of cell number. Throws InputError when there are fewer cells.
std::vector<int> central_cells(const TissueState& state, int count);

/// The same state without the given cells. Throws InputError when none would be left, when a cell does not exist or is
/// named twice, or when the state has a purse string.
TissueState remove_cells(const TissueState& state, const std::vector<int>& cells);

struct Ablated {
  TissueState state;         ///< its rest lengths are the reference of shape memory, l0_ref
  std::vector<int> removed;  ///< cells of the annealed tissue, nearest the centre first
  Statistics statistics;
};

/// Removes the wound.cells central cells; the others relax, overdamped and elastic, for wound.relaxation_time.
Ablated ablate(const Config& config, const TissueState& annealed, const Progress& progress = {},
               const StepWatch<RelaxationState>& watch = {});

}  // namespace suture
