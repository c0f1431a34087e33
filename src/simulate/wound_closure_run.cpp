#include "simulate/wound_closure_run.hpp"

#include <fmt/format.h>

#include "io/atomic_file.hpp"
#include "io/checkpoint_file.hpp"
#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/setup/protocol.hpp"
#include "suture/simulate/closure.hpp"

namespace suture {

namespace {

/// Thrown through the preparation, between two of its steps.
struct StopRequested {};

RunStatus run_status(ClosureStatus status) {
  switch (status) {
    case ClosureStatus::closed: return RunStatus::closed;
    case ClosureStatus::reached_end: return RunStatus::reached_t_end;
    case ClosureStatus::stopped: return RunStatus::stopped;
    case ClosureStatus::opened: return RunStatus::failed;
  }
  return RunStatus::failed;
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

}  // namespace

std::optional<Resumption> find_resumption(const RunRequest& request, std::vector<std::string>& problems) {
  std::optional<Resumption> found;
  use_newest_checkpoint(
      request.directory,
      [&](std::string_view payload) {
        RunCheckpoint checkpoint;
        ByteReader reader(payload);
        reader(checkpoint);
        reader.expect_end();
        expect_same_configuration(request.directory, checkpoint.resolved_config, request.config);
        TrajectoryWriter writer = TrajectoryWriter::resume(request.directory / "run.h5", checkpoint.journal_length);
        found.emplace(Resumption{std::move(checkpoint), std::move(writer)});
      },
      problems);
  return found;
}

WoundClosureRun::WoundClosureRun(const RunRequest& request, TrajectoryWriter writer)
    : request_(request),
      config_(request.config),
      writer_(std::move(writer)),
      recorder_(
          request, writer_, [this](auto stage, double fraction, auto text) { report(stage, fraction, text); },
          [this] { return checkpoint_due(); },
          [this](const std::string& closure, double time, SavePoint point) {
            if (is_to_be_written(point)) save(ClosureProgress{closure, recorder_.saved()}, time, point);
          }),
      outcome_{start_summary(request.config), {}} {}

WoundClosureRun::WoundClosureRun(const RunRequest& request, SavedStage start)
    : WoundClosureRun(request, TrajectoryWriter(request.directory / "run.h5", request.provenance)) {
  start_ = std::move(start);
  writer_.commit();  // from here on the folder is ours
  remove_checkpoints(request.directory);
  remove_partial_files(request.directory);
}

WoundClosureRun::WoundClosureRun(const RunRequest& request, Resumption resumption)
    : WoundClosureRun(request, std::move(resumption.writer)) {
  fresh_ = false;
  remove_partial_files(request.directory);
  RunCheckpoint& checkpoint = resumption.checkpoint;
  outcome_.summary.wall_s = checkpoint.wall_s;
  outcome_.summary.solver = checkpoint.solver;
  resumed_ = std::move(checkpoint.progress);
  if (const auto* closure = std::get_if<ClosureProgress>(&*resumed_))
    recorder_.restore(closure->recorder, read_wound_samples(journal_path(request.directory / "run.h5")));
  const bool reproducible = checkpoint.reproducible && checkpoint.build == build_identity();
  writer_.record(Continuation{checkpoint.time, reproducible, utc_now()});
  writer_.commit();
}

bool WoundClosureRun::checkpoint_due() const {
  return stop_requested() || saved_watch_.seconds() >= config_.checkpoint.wall_interval;
}

bool WoundClosureRun::is_to_be_written(SavePoint point) const {
  constexpr double natural_interval = 1.0;  // s; the stops of a reproducible run fall back to these points
  const bool reproducible = config_.checkpoint.reproducible;
  switch (point) {
    case SavePoint::configured: return true;
    case SavePoint::natural: return checkpoint_due() || (reproducible && saved_watch_.seconds() >= natural_interval);
    case SavePoint::between: return !reproducible;
  }
  return true;
}

void WoundClosureRun::save(SavedProgress progress, double time, SavePoint point) {
  writer_.commit();
  writer_.sync();  // the checkpoint counts on what is in the journal
  const RunCheckpoint checkpoint{.resolved_config = write_config(config_),
                                 .build = build_identity(),
                                 .reproducible = point != SavePoint::between,
                                 .time = time,
                                 .journal_length = writer_.length(),
                                 .wall_s = wall_so_far(),
                                 .solver = outcome_.summary.solver,
                                 .progress = std::move(progress)};
  write_checkpoint(request_.directory, to_bytes(checkpoint));
  saved_watch_ = {};
}

/// Called once this run has something of its own.
void WoundClosureRun::remove_old_outputs() const {
  std::error_code ignored;
  for (const char* name : {"run.h5", "summary.json", "wound.csv"}) std::filesystem::remove(request_.directory / name, ignored);
}

void WoundClosureRun::begin_stage(const char* name) {
  outcome_.summary.wall_s = wall_so_far();
  stage_ = name;
  stage_watch_ = {};
}

std::map<std::string, double> WoundClosureRun::wall_so_far() const {
  std::map<std::string, double> wall = outcome_.summary.wall_s;
  if (!stage_.empty()) wall[stage_] += stage_watch_.seconds();
  return wall;
}

/// To whoever asked for progress, and into status.json about once a second.
void WoundClosureRun::report(std::string_view stage, double fraction, std::string_view text) {
  report_progress(request_.progress, stage, fraction, text);
  const double now = run_watch_.seconds();
  if (stage != note_.stage) {
    note_.stage = stage;
    first_fraction_ = fraction, stage_begun_ = now;
  } else if (now - noted_ < 1.0) {
    return;
  }
  if (now < 1.0) return;  // over before anyone asks
  noted_ = now;
  note_.fraction = fraction, note_.text = text, note_.wall_s = now, note_.state = "running";
  const double gained = fraction - first_fraction_;
  note_.eta_s = gained > 0.0 ? std::optional((now - stage_begun_) * (1.0 - fraction) / gained) : std::nullopt;
  write_status(request_.directory, note_);
}

/// Everything before the closure: run, taken from an earlier run, or taken up again.
void WoundClosureRun::prepare() {
  begin_stage("preparation");
  const Progress progress = [this](auto stage, double fraction, auto text) { report(stage, fraction, text); };
  const StageEnd stage_end = [this](Stage stage, const TissueState& state) {
    if (std::exchange(fresh_, false)) remove_old_outputs();
    writer_.write_stage(stage, state);
    writer_.commit();
  };
  StepWatch<PreparationState> watch{
      .due = [this] { return checkpoint_due(); },
      .save =
          [this](PreparationState state, SavePoint point) {
            const double time = time_of(state);
            if (is_to_be_written(point)) save(std::move(state), time, point);
            if (stop_requested()) throw StopRequested{};
          }};
  if (resumed_) watch.resumed = std::move(std::get<PreparationState>(*resumed_));
  const bool given = !config_.run.start_from.empty();
  if (given && !start_) start_.emplace();  // resumed: `watch` has the state
  Preparation result = given ? continue_preparation(config_, start_->first, std::move(start_->second), progress, stage_end, std::move(watch))
                             : prepare_tissue(config_, progress, stage_end, std::move(watch));
  prepared_ = std::move(result.state);
  outcome_.summary.solver += result.relaxation;
}

void WoundClosureRun::run_closure_stage(TissueState& last_good) {
  const auto* saved = resumed_ ? std::get_if<ClosureProgress>(&*resumed_) : nullptr;
  const ClosureResult result = saved ? resume_closure(config_, saved->closure, recorder_, last_good)
                                     : run_closure(config_, std::move(prepared_), recorder_, last_good);
  outcome_.summary.status = run_status(result.status);
  outcome_.summary.t_closed = result.t_closed;
  outcome_.summary.solver += result.statistics;
  if (result.status == ClosureStatus::opened) outcome_.failure = "the wound has broken through the rim of the tissue";
  last_good = result.state;
}

void WoundClosureRun::close_wound() {
  begin_stage("closure");
  TissueState last_good;
  try {
    run_closure_stage(last_good);
  } catch (const NumericalError& error) {
    outcome_.summary.status = RunStatus::failed;
    outcome_.failure = error.what();
  }
  if (outcome_.summary.status != RunStatus::stopped && !last_good.values.empty()) writer_.write_stage(Stage::closure, last_good);
}

/// Results for people; after a stop also what the continuation needs stays.
void WoundClosureRun::publish() {
  begin_stage("");
  const bool finished = outcome_.summary.status != RunStatus::stopped;
  recorder_.summarise(outcome_.summary);
  writer_.write_summary(outcome_.summary);
  writer_.publish(finished);
  write_summary(outcome_.summary, request_.directory / "summary.json");
  recorder_.write_csv();
  recorder_.draw();
  if (finished) {
    writer_.discard_journal();
    remove_leftovers(request_.directory);
  } else {
    note_.state = "stopped", note_.wall_s = run_watch_.seconds(), note_.eta_s.reset();
    write_status(request_.directory, note_);
  }
}

RunOutcome WoundClosureRun::run() {
  try {
    if (!resumed_ || std::holds_alternative<PreparationState>(*resumed_)) {
      prepare();
      resumed_.reset();
    }
    if (std::exchange(fresh_, false)) remove_old_outputs();
    outcome_.summary.status = RunStatus::reached_t_end;
    if (config_.run.last_stage == Stage::closure)
      close_wound();
    else
      writer_.write_frame(prepared_);
  } catch (const NumericalError& error) {
    outcome_.summary.status = RunStatus::failed;
    outcome_.failure = error.what();
  } catch (const StopRequested&) {
    outcome_.summary.status = RunStatus::stopped;
  } catch (const InputError&) {
    if (fresh_) writer_.discard_journal();  // bad input leaves nothing behind
    throw;
  }
  publish();
  return outcome_;
}

}  // namespace suture
