// Stage 1 of the protocol: cells placed at random in a circular wall and compressed in small steps, each followed by an
// energy minimisation (model.md section 6; Ton et al. 2023, supplement section II).
#pragma once

#include <cstdint>

#include "suture/model/parameters.hpp"
#include "suture/model/state.hpp"
#include "suture/setup/progress.hpp"

namespace suture {

struct PackingReport {
  double fraction = 0.0;       ///< packing fraction reached
  double largest_force = 0.0;  ///< largest force component after the last minimisation
  int compression_steps = 0;
  std::int64_t iterations = 0;  ///< of FIRE
};

struct Packing {
  TissueState state;         ///< with the materials of the run, not those used while packing
  double wall_radius = 0.0;  ///< of the circular wall around the origin
  PackingReport report;
};

/// Area covered by the cells with their membranes, sum of a + p sigma + pi sigma^2, sigma half a membrane width.
double covered_area(const TissueState& state, double half_membrane);

/// Packs the tissue `config` describes; the same config gives the same bits. Throws InputError when the fractions make
/// no sense, NumericalError when a minimisation does not reach packing.force_tolerance.
Packing make_packing(const Config& config, const Progress& progress = {});

}  // namespace suture
