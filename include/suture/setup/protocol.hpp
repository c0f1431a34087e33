// The stages of a wound-closure run up to, not including, closure: packing, anneal, ablation (model.md section 6;
// docs/explanation/protocol.md). Each stage takes a state and returns one, so a run can start from the saved end of
// any.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "suture/setup/ablation.hpp"
#include "suture/setup/acceptance.hpp"
#include "suture/setup/anneal.hpp"
#include "suture/setup/packing.hpp"

namespace suture {

/// The same configuration with contact.distance set. Resolve once, before any cell is removed: the default, the mean
/// initial rest length, is that of the whole tissue.
Config with_contact_distance(Config config);

/// A tissue on its way to closure, and how it came there. Reports of stages that were not run are empty.
struct Preparation {
  Stage stage = Stage::packing;      ///< last one completed
  TissueState state;                 ///< at its end
  int attempt = 0;                   ///< of tissue.seed, counted from 0
  std::vector<std::string> refused;  ///< why each earlier attempt was refused
  double wall_radius = 0.0;
  PackingReport packing;
  EnergyReport anneal_energy;
  Statistics relaxation;  ///< of both overdamped motions together
  std::vector<int> removed_cells;
  Acceptance acceptance;  ///< of `state`; stays empty after the packing stage
};

/// A preparation on its way.
struct PreparationState {
  Preparation so_far;  ///< `stage` and `state` are those of the last stage completed; meaningless while packing
  /// Within packing, anneal or the relaxation after ablation; empty: at the end of so_far.stage.
  std::variant<std::monostate, CompressionState, AnnealState, RelaxationState> step;
};

/// Called at the end of every stage of an attempt, before the tissue is judged.
using StageEnd = std::function<void(Stage stage, const TissueState& state)>;

/// Runs the stages up to run.last_stage, at most to ablation. A tissue that is refused (see Acceptance) is packed again
/// from other random numbers of the same seed, packing.attempts times at most; the outcome depends on `config` only.
/// Throws InputError or, when every attempt is refused or a stage fails, NumericalError.
Preparation prepare_tissue(const Config& config, const Progress& progress = {}, const StageEnd& stage_end = {},
                           StepWatch<PreparationState> watch = {});

/// Continues from the saved end of stage `completed` (packing, anneal or ablation). Throws NumericalError when the
/// tissue is refused: it cannot be packed again.
Preparation continue_preparation(const Config& config, Stage completed, TissueState state,
                                 const Progress& progress = {}, const StageEnd& stage_end = {},
                                 StepWatch<PreparationState> watch = {});

}  // namespace suture
