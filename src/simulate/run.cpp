#include "suture/simulate/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <utility>

#include "io/checkpoint_file.hpp"
#include "io/journal.hpp"
#include "simulate/wound_closure_run.hpp"
#include "suture/errors.hpp"
#include "suture/io/run_status.hpp"
#include "suture/setup/protocol.hpp"
#include "suture/simulate/cell_experiment.hpp"

namespace suture {

namespace {

/// A state read from a file, with the materials this configuration asks for, so that one packing serves many parameter
/// points. The file does not say of which type a cell is, so typed cells must still all be there.
TissueState with_configured_materials(const Config& config, TissueState state) {
  const Tissue configured = make_tissue(config);
  const int cells = state.tissue.cell_count();
  const bool complete = cells == configured.cell_count();
  if (!complete && !config.cell_types.empty())
    throw InputError(fmt::format("{}: {} of the {} cells are left, so [[cell_type]] cannot be matched to them; start from the "
                                 "packing or anneal stage",
                                 config.run.start_from, cells, configured.cell_count()));
  if (cells > configured.cell_count())
    throw InputError(fmt::format("{}: holds {} cells, but tissue.cells is {}", config.run.start_from, cells, configured.cell_count()));
  std::vector<CellMaterial> materials;
  for (int c = 0; c < cells; ++c) materials.push_back(configured.material(complete ? c : 0));
  state.tissue = state.tissue.with_materials(std::move(materials));
  return state;
}

/// The stage run.start_from names, read before anything is written.
SavedStage read_start(const Config& config) {
  if (config.run.start_from.empty()) return std::nullopt;
  auto [stage, state] = read_last_stage(config.run.start_from);
  if (stage == Stage::closure)
    throw InputError(fmt::format("{}: the run is complete; nothing is left to continue", config.run.start_from));
  return std::pair{stage, with_configured_materials(config, std::move(state))};
}

RunOutcome run_one_cell(const RunRequest& request) {
  std::filesystem::create_directories(request.directory);
  const CellExperimentResult result = run_cell_experiment(request.config, request.progress);
  write_cell_experiment(result, request.config, request.provenance, request.directory);
  return {summarise(result, request.config), result.failure.value_or("")};
}

/// More than the header: a run that was killed at once has nothing to lose.
bool holds_results(const std::filesystem::path& journal) {
  try {
    JournalReader reader(journal, OnDamage::skip);
    std::string block;
    return reader.next(block) && reader.next(block);
  } catch (const FileError&) {
    return false;
  }
}

}  // namespace

DirectoryContent content_of(const std::filesystem::path& directory) {
  const auto holds = [&](const std::filesystem::path& path) { return std::filesystem::exists(path); };
  if (holds(journal_path(directory / "run.h5"))) return DirectoryContent::unfinished;  // it is removed when run.h5 is complete
  return holds(directory / "run.h5") ? DirectoryContent::finished : DirectoryContent::nothing;
}

void remove_leftovers(const std::filesystem::path& directory) {
  remove_checkpoints(directory);
  remove_status(directory);
}

void remove_pictures(const std::filesystem::path& directory) {
  std::error_code ignored;
  for (const char* name : {"final.png", "final.svg", "strip.png"}) std::filesystem::remove(directory / name, ignored);
  for (int k = 0; std::filesystem::remove(directory / fmt::format("frame_{:02}.png", k), ignored); ++k) continue;
}

RunOutcome run_protocol(const RunRequest& original) {
  if (original.config.run.protocol != Protocol::wound_closure) return run_one_cell(original);
  RunRequest request = original;
  request.config = with_contact_distance(request.config);
  std::vector<std::string> problems;
  if (request.resume && content_of(request.directory) == DirectoryContent::unfinished)
    if (std::optional<Resumption> resumption = find_resumption(request, problems))
      return WoundClosureRun(request, *std::move(resumption)).run();
  if (!problems.empty() && holds_results(journal_path(request.directory / "run.h5")))
    throw InputError(fmt::format("{}: no checkpoint can be used: {}; 'suture recover {}' saves what was computed",
                                 request.directory.string(), fmt::join(problems, "; "), request.directory.string()));
  SavedStage start = read_start(request.config);
  std::filesystem::create_directories(request.directory);
  return WoundClosureRun(request, std::move(start)).run();
}

}  // namespace suture
