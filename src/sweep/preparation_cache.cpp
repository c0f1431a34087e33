#include "suture/sweep/preparation_cache.hpp"

#include <chrono>
#include <thread>

#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/io/trajectory.hpp"
#include "suture/setup/protocol.hpp"
#include "suture/sweep/claim.hpp"
#include "suture/sweep/plan.hpp"

namespace suture {

namespace {

void prepare_into(const std::filesystem::path& file, const Config& config, const std::function<bool()>& stop) {
  const Progress asked = [&stop](std::string_view, double, std::string_view) {
    if (stop && stop()) throw PreparationStopped{};
  };
  const Preparation prepared = prepare_tissue(config, asked);
  Provenance provenance;
  provenance.resolved_config = write_config(config);
  provenance.command_line = "preparation shared by the runs of a sweep";
  provenance.start_time = utc_now();
  provenance.seed = config.tissue.seed;
  TrajectoryWriter writer(file, provenance);
  writer.write_stage(prepared.stage, prepared.state);
  writer.close();
}

/// Two configurations with the same hash must not share a tissue.
void check_same(const std::filesystem::path& file, const std::string& expected) {
  if (read_trajectory(file).provenance.resolved_config != expected)
    throw FileError(file.string() + ": holds the preparation of another configuration; remove it");
}

}  // namespace

bool can_share_preparation(const Config& config) {
  return config.run.protocol == Protocol::wound_closure && config.run.last_stage == Stage::closure &&
         config.run.start_from.empty() && config.cell_types.empty();
}

Config preparation_config(const Config& config) {
  Config relevant = config;
  relevant.preset = Config{}.preset;
  relevant.purse_string = {};
  relevant.plasticity = {};
  relevant.run = {};
  relevant.run.last_stage = Stage::ablation;
  relevant.output = {};
  relevant.units = {};
  relevant.compression = {};
  relevant.dipole = {};
  relevant.integrator = {};
  relevant.integrator.skin = config.integrator.skin;
  relevant.integrator.threads = config.integrator.threads;
  return relevant;
}

std::filesystem::path shared_preparation(const Config& config, const std::filesystem::path& folder, double lease_s,
                                         const std::function<bool()>& stop) {
  const Config relevant = preparation_config(config);
  const std::string text = write_config(relevant), name = text_hash(text);
  const std::filesystem::path file = folder / (name + ".h5");
  while (!std::filesystem::exists(file)) {
    std::optional<Claim> claim = Claim::take(folder, name, lease_s);
    if (claim && !std::filesystem::exists(file)) prepare_into(file, relevant, stop);
    if (claim) claim->finish();
    if (stop && stop()) throw PreparationStopped{};
    if (!claim) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  check_same(file, text);
  return file;
}

}  // namespace suture
