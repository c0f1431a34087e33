// Which prepared tissues are fit for a closure run: one confluent patch with a wound of the right size (model.md
// section 6). Areas are free space beyond half a membrane, as measured by inspect_patch.
#pragma once

#include <optional>
#include <string>

#include "suture/model/parameters.hpp"
#include "suture/model/state.hpp"

namespace suture {

struct Acceptance {
  bool accepted = false;
  int components = 0;                ///< patches of cells in contact; 1 when accepted
  double largest_hole = 0.0;         ///< between the cells, the wound left out
  std::optional<double> wound_area;  ///< only of a wounded tissue
  std::string reason;                ///< why it is refused; empty when accepted
};

/// Judges an annealed tissue (not wounded): one patch, no hole larger than wound.maximum_hole.
Acceptance judge_annealed(const Config& config, const TissueState& state);

/// Judges a wounded tissue: the same, and a wound area between wound.minimum_area and wound.maximum_area.
Acceptance judge_wounded(const Config& config, const TissueState& state);

}  // namespace suture
