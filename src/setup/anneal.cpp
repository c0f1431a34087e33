#include "suture/setup/anneal.hpp"

#include <fmt/format.h>

#include "setup/energy_options.hpp"

namespace suture {

Annealed anneal(const Config& config, TissueState packed, const Progress& progress, int attempt) {
  Annealed annealed{.state = std::move(packed)};
  TissueState& state = annealed.state;
  const AnnealParameters& options = config.anneal;
  if (options.duration > 0.0) {
    report_progress(progress, "anneal", 0.0, "constant-energy motion");
    Config resolved = config;
    resolved.contact.distance = contact_distance(config);
    std::vector<double> velocities = maxwell_velocities(state, options.temperature, config.tissue.seed, attempt);
    TissueOde ode(state.tissue, 0, elastic_options(config, config.contact.adhesion), {});
    annealed.energy = move_at_constant_energy(ode, make_cell_terms(state.tissue, resolved), state, velocities,
                                              options.duration, options.time_step);
  }
  annealed.statistics = relax_overdamped(
      config, state, options.relaxation_time,
      [&progress](double fraction, std::string_view text) { report_progress(progress, "anneal", fraction, text); });
  return annealed;
}

}  // namespace suture
