#include "suture/simulate/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include "simulate/run_recorder.hpp"
#include "suture/errors.hpp"
#include "suture/io/units.hpp"
#include "suture/setup/protocol.hpp"
#include "suture/simulate/cell_experiment.hpp"
#include "suture/simulate/closure.hpp"

namespace suture {

namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Thrown through the preparation by its progress callback, the only place it asks whether to go on.
struct StopRequested {};

Progress with_stop(const RunRequest& request) {
  return [&request](std::string_view stage, double fraction, std::string_view text) {
    report_progress(request.progress, stage, fraction, text);
    if (request.stop && request.stop()) throw StopRequested{};
  };
}

struct Prepared {
  std::map<Stage, TissueState> stages;  ///< ends of the stages that were run
  Stage last = Stage::packing;
  TissueState state;
};

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

using SavedStage = std::optional<std::pair<Stage, TissueState>>;

/// The stage run.start_from names, read before anything is written.
SavedStage read_start(const Config& config) {
  if (config.run.start_from.empty()) return std::nullopt;
  auto [stage, state] = read_last_stage(config.run.start_from);
  if (stage == Stage::closure)
    throw InputError(fmt::format("{}: the run is complete; nothing is left to continue", config.run.start_from));
  return std::pair{stage, with_configured_materials(config, std::move(state))};
}

/// Everything before the closure: run, or taken from an earlier run.
Prepared prepare(const RunRequest& request, const Config& config, SavedStage start, RunSummary& summary) {
  const Stopwatch watch;
  Prepared prepared;
  const auto keep = [&](Stage stage, const TissueState& state) { prepared.stages.insert_or_assign(stage, state); };
  Preparation result = start ? continue_preparation(config, start->first, std::move(start->second), with_stop(request), keep)
                             : prepare_tissue(config, with_stop(request), keep);
  prepared.last = result.stage;
  prepared.state = std::move(result.state);
  summary.wall_s["preparation"] = watch.seconds();
  summary.solver += result.relaxation;
  return prepared;
}

RunStatus run_status(ClosureStatus status) {
  switch (status) {
    case ClosureStatus::closed: return RunStatus::closed;
    case ClosureStatus::reached_end: return RunStatus::reached_t_end;
    case ClosureStatus::stopped: return RunStatus::stopped;
    case ClosureStatus::opened: return RunStatus::failed;
  }
  return RunStatus::failed;
}

void close_wound(const Config& config, TissueState state, RunRecorder& recorder, TrajectoryWriter& writer, RunOutcome& outcome) {
  const Stopwatch watch;
  TissueState last_good;
  try {
    const ClosureResult result = run_closure(config, std::move(state), recorder, last_good);
    outcome.summary.status = run_status(result.status);
    outcome.summary.t_closed = result.t_closed;
    outcome.summary.solver += result.statistics;
    if (result.status == ClosureStatus::opened) outcome.failure = "the wound has broken through the rim of the tissue";
    last_good = result.state;
  } catch (const NumericalError& error) {
    outcome.summary.status = RunStatus::failed;
    outcome.failure = error.what();
  }
  if (!last_good.values.empty()) writer.write_stage(Stage::closure, last_good);
  outcome.summary.wall_s["closure"] = watch.seconds();
}

RunSummary start_summary(const Config& config) {
  RunSummary summary;
  summary.seed = config.tissue.seed;
  summary.k_a = config.area.stiffness;
  summary.tau = config.plasticity.tau;
  summary.xi = config.plasticity.memory;
  summary.units = config.units;
  return summary;
}

RunOutcome run_one_cell(const RunRequest& request) {
  std::filesystem::create_directories(request.directory);
  const CellExperimentResult result = run_cell_experiment(request.config, request.progress);
  write_cell_experiment(result, request.config, request.provenance, request.directory);
  return {summarise(result, request.config), result.failure.value_or("")};
}

}  // namespace

RunOutcome run_protocol(const RunRequest& original) {
  if (original.config.run.protocol != Protocol::wound_closure) return run_one_cell(original);
  RunRequest request = original;
  request.config = with_contact_distance(request.config);
  const Config& config = request.config;
  RunOutcome outcome{start_summary(config), {}};
  SavedStage start = read_start(config);
  std::filesystem::create_directories(request.directory);
  TrajectoryWriter writer(request.directory / "run.h5", request.provenance);
  RunRecorder recorder(request, writer);
  try {
    Prepared prepared = prepare(request, config, std::move(start), outcome.summary);
    for (const auto& [stage, state] : prepared.stages) writer.write_stage(stage, state);
    writer.commit();
    outcome.summary.status = RunStatus::reached_t_end;
    if (config.run.last_stage == Stage::closure)
      close_wound(config, std::move(prepared.state), recorder, writer, outcome);
    else
      writer.write_frame(prepared.state);
  } catch (const NumericalError& error) {
    outcome.summary.status = RunStatus::failed;
    outcome.failure = error.what();
  } catch (const StopRequested&) {
    outcome.summary.status = RunStatus::stopped;
  }
  recorder.summarise(outcome.summary);
  writer.write_summary(outcome.summary);
  writer.close();
  write_summary(outcome.summary, request.directory / "summary.json");
  recorder.write_csv();
  recorder.draw();
  return outcome;
}

}  // namespace suture
