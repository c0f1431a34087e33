#include "suture/setup/protocol.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "setup/energy_options.hpp"
#include "suture/errors.hpp"

namespace suture {

namespace {

/// Runs what is left of the stages up to `last`; stops where the tissue is refused.
void advance(const Config& config, Stage last, Preparation& preparation, const Progress& progress,
             const StageEnd& stage_end) {
  const auto complete = [&](Stage stage) {
    preparation.stage = stage;
    if (stage_end) stage_end(stage, preparation.state);
  };
  if (preparation.stage == Stage::packing && last > Stage::packing) {
    Annealed annealed = anneal(config, std::move(preparation.state), progress, preparation.attempt);
    preparation.state = std::move(annealed.state);
    preparation.anneal_energy = annealed.energy;
    preparation.relaxation += annealed.statistics;
    complete(Stage::anneal);
  }
  if (preparation.stage == Stage::anneal) {
    preparation.acceptance = judge_annealed(config, preparation.state);
    if (last == Stage::anneal || !preparation.acceptance.accepted) return;
    Ablated ablated = ablate(config, preparation.state, progress);
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

}  // namespace

Config with_contact_distance(Config config) {
  config.contact.distance = contact_distance(config);
  return config;
}

Preparation prepare_tissue(const Config& given, const Progress& progress, const StageEnd& stage_end) {
  const Config config = with_contact_distance(given);
  std::vector<std::string> refused;
  for (int attempt = 0; attempt < config.packing.attempts; ++attempt) {
    Packing packing = make_packing(config, progress, attempt);
    Preparation preparation{.state = std::move(packing.state),
                            .attempt = attempt,
                            .refused = refused,
                            .wall_radius = packing.wall_radius,
                            .packing = packing.report};
    if (stage_end) stage_end(Stage::packing, preparation.state);
    advance(config, last_stage(config), preparation, progress, stage_end);
    if (good(preparation)) return preparation;
    refused.push_back(preparation.acceptance.reason);
    report_progress(progress, "packing", 0.0,
                    fmt::format("attempt {} is refused: {}", attempt + 1, preparation.acceptance.reason));
  }
  throw NumericalError(fmt::format("no acceptable tissue from tissue.seed = {} in packing.attempts = {}: {}",
                                   config.tissue.seed, config.packing.attempts, fmt::join(refused, "; ")));
}

Preparation continue_preparation(const Config& given, Stage completed, TissueState state, const Progress& progress,
                                 const StageEnd& stage_end) {
  if (completed > Stage::ablation) throw InputError("a tissue whose closure has begun cannot be prepared again");
  const Config config = with_contact_distance(given);
  Preparation preparation{.stage = completed, .state = std::move(state)};
  advance(config, last_stage(config), preparation, progress, stage_end);
  if (!good(preparation))
    throw NumericalError(fmt::format("the tissue that was given is refused: {}", preparation.acceptance.reason));
  return preparation;
}

}  // namespace suture
