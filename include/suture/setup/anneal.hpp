// Stage 2 of the protocol: the wall goes, adhesion comes, the cells are shaken and settle (model.md section 6).
#pragma once

#include <optional>

#include "suture/setup/dynamics.hpp"
#include "suture/setup/progress.hpp"

namespace suture {

struct Annealed {
  TissueState state;
  EnergyReport energy;    ///< of the constant-energy motion
  Statistics statistics;  ///< of the overdamped relaxation
};

/// An anneal on its way: in one of its two motions.
struct AnnealState {
  std::optional<ConstantEnergyState> motion;
  EnergyReport energy;  ///< of the constant-energy motion, once it is over
  std::optional<RelaxationState> relaxation;
};

/// Constant-energy motion from Maxwell velocities at anneal.temperature for anneal.duration, then overdamped motion of
/// elastic cells for anneal.relaxation_time. Throws NumericalError.
Annealed anneal(const Config& config, TissueState packed, const Progress& progress = {}, int attempt = 0,
                const StepWatch<AnnealState>& watch = {});

}  // namespace suture
