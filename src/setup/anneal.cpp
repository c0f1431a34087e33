#include "suture/setup/anneal.hpp"

#include <fmt/format.h>

#include "setup/energy_options.hpp"

namespace suture {

namespace {

EnergyReport shake(const Config& config, TissueState& state, int attempt, const StepWatch<AnnealState>& watch) {
  Config resolved = config;
  resolved.contact.distance = contact_distance(config);
  StepWatch<ConstantEnergyState> inner{.due = watch.due};
  if (watch.save)
    inner.save = [&watch](ConstantEnergyState motion, SavePoint point) { watch.save({.motion = std::move(motion)}, point); };
  if (watch.resumed) inner.resumed = watch.resumed->motion;
  if (inner.resumed) state = inner.resumed->state;
  std::vector<double> velocities = maxwell_velocities(state, config.anneal.temperature, config.tissue.seed, attempt);
  const auto make_ode = [&config, tissue = state.tissue] {
    return std::make_unique<TissueOde>(tissue, 0, elastic_options(config, config.contact.adhesion),
                                       std::vector<std::shared_ptr<const EnergyTerm>>{});
  };
  return move_at_constant_energy(make_ode, make_cell_terms(state.tissue, resolved), state, velocities,
                                 config.anneal.duration, config.anneal.time_step, config.checkpoint.interval, inner);
}

}  // namespace

Annealed anneal(const Config& config, TissueState packed, const Progress& progress, int attempt,
                const StepWatch<AnnealState>& watch) {
  Annealed annealed{.state = std::move(packed)};
  const bool shaken = watch.resumed && watch.resumed->relaxation;
  if (shaken) {
    annealed.energy = watch.resumed->energy;
  } else if (config.anneal.duration > 0.0) {
    report_progress(progress, "anneal", 0.0, "constant-energy motion");
    annealed.energy = shake(config, annealed.state, attempt, watch);
  }
  StepWatch<RelaxationState> inner{.due = watch.due};
  if (watch.save)
    inner.save = [&](RelaxationState relaxation, SavePoint point) {
      watch.save({.energy = annealed.energy, .relaxation = std::move(relaxation)}, point);
    };
  if (shaken) inner.resumed = watch.resumed->relaxation;
  annealed.statistics = relax_overdamped(
      config, annealed.state, config.anneal.relaxation_time,
      [&progress](double fraction, std::string_view text) { report_progress(progress, "anneal", fraction, text); }, inner);
  return annealed;
}

}  // namespace suture
