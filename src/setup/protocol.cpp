#include "suture/setup/protocol.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "setup/energy_options.hpp"
#include "suture/errors.hpp"

namespace suture {

namespace {

/// The watch of one step of a preparation that stands at `so_far`. What it was to be resumed from is used once.
template <class State>
StepWatch<State> within(StepWatch<PreparationState>& outer, const Preparation& so_far) {
  StepWatch<State> inner{.due = outer.due};
  if (outer.save)
    inner.save = [&outer, &so_far](State step, SavePoint point) { outer.save({so_far, std::move(step)}, point); };
  if (outer.resumed) {
    if (auto* step = std::get_if<State>(&outer.resumed->step)) inner.resumed = std::move(*step);
    outer.resumed.reset();
  }
  return inner;
}

/// Runs what is left of the stages up to `last`; stops where the tissue is refused.
void advance(const Config& config, Stage last, Preparation& preparation, const Progress& progress,
             const StageEnd& stage_end, StepWatch<PreparationState>& watch) {
  const auto complete = [&](Stage stage) {
    preparation.stage = stage;
    if (stage_end) stage_end(stage, preparation.state);
  };
  const auto offer_end_of_stage = [&] {
    if (!watch.resumed) watch.offer(SavePoint::natural, [&] { return PreparationState{preparation, {}}; });
  };
  if (preparation.stage == Stage::packing && last > Stage::packing) {
    offer_end_of_stage();
    TissueState packed = std::move(preparation.state);
    preparation.state = {};  // each state is saved once: what anneal saves has its own
    Annealed annealed =
        anneal(config, std::move(packed), progress, preparation.attempt, within<AnnealState>(watch, preparation));
    preparation.state = std::move(annealed.state);
    preparation.anneal_energy = annealed.energy;
    preparation.relaxation += annealed.statistics;
    complete(Stage::anneal);
  }
  if (preparation.stage == Stage::anneal) {
    preparation.acceptance = judge_annealed(config, preparation.state);
    if (last == Stage::anneal || !preparation.acceptance.accepted) return;
    offer_end_of_stage();
    Ablated ablated = ablate(config, preparation.state, progress, within<RelaxationState>(watch, preparation));
    preparation.state = std::move(ablated.state);
    preparation.removed_cells = std::move(ablated.removed);
    preparation.relaxation += ablated.statistics;
    complete(Stage::ablation);
  }
  if (preparation.stage == Stage::ablation) preparation.acceptance = judge_wounded(config, preparation.state);
}

Stage last_stage(const Config& config) { return std::min(config.run.last_stage, Stage::ablation); }

bool good(const Preparation& preparation) {
  return preparation.stage == Stage::packing || preparation.acceptance.accepted;
}

/// Packed, or where the saved preparation stands: not packed again if it is beyond.
Preparation start_attempt(const Config& config, int attempt, std::vector<std::string> refused, const Progress& progress,
                          const StageEnd& stage_end, StepWatch<PreparationState>& watch) {
  if (watch.resumed && !std::holds_alternative<CompressionState>(watch.resumed->step)) return watch.resumed->so_far;
  Preparation preparation{.attempt = attempt, .refused = std::move(refused)};
  Packing packing = make_packing(config, progress, attempt, within<CompressionState>(watch, preparation));
  preparation.state = std::move(packing.state);
  preparation.wall_radius = packing.wall_radius;
  preparation.packing = packing.report;
  if (stage_end) stage_end(Stage::packing, preparation.state);
  return preparation;
}

}  // namespace

Config with_contact_distance(Config config) {
  config.contact.distance = contact_distance(config);
  return config;
}

Preparation prepare_tissue(const Config& given, const Progress& progress, const StageEnd& stage_end,
                           StepWatch<PreparationState> watch) {
  const Config config = with_contact_distance(given);
  std::vector<std::string> refused;
  int attempt = 0;
  if (watch.resumed) refused = watch.resumed->so_far.refused, attempt = watch.resumed->so_far.attempt;
  for (; attempt < config.packing.attempts; ++attempt) {
    Preparation preparation = start_attempt(config, attempt, refused, progress, stage_end, watch);
    advance(config, last_stage(config), preparation, progress, stage_end, watch);
    watch.resumed.reset();
    if (good(preparation)) return preparation;
    refused.push_back(preparation.acceptance.reason);
    report_progress(progress, "packing", 0.0,
                    fmt::format("attempt {} is refused: {}", attempt + 1, preparation.acceptance.reason));
  }
  throw NumericalError(fmt::format("no acceptable tissue from tissue.seed = {} in packing.attempts = {}: {}",
                                   config.tissue.seed, config.packing.attempts, fmt::join(refused, "; ")));
}

Preparation continue_preparation(const Config& given, Stage completed, TissueState state, const Progress& progress,
                                 const StageEnd& stage_end, StepWatch<PreparationState> watch) {
  if (completed > Stage::ablation) throw InputError("a tissue whose closure has begun cannot be prepared again");
  const Config config = with_contact_distance(given);
  Preparation preparation{.stage = completed, .state = std::move(state)};
  if (watch.resumed) preparation = watch.resumed->so_far;
  advance(config, last_stage(config), preparation, progress, stage_end, watch);
  if (!good(preparation))
    throw NumericalError(fmt::format("the tissue that was given is refused: {}", preparation.acceptance.reason));
  return preparation;
}

}  // namespace suture
