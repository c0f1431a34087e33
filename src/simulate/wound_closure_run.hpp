// One run of the wound-closure protocol, from the beginning or from a checkpoint: prepares, closes, saves, publishes.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simulate/run_checkpoint.hpp"
#include "simulate/run_recorder.hpp"
#include "suture/io/run_status.hpp"
#include "suture/io/trajectory.hpp"
#include "suture/simulate/run.hpp"

namespace suture {

using SavedStage = std::optional<std::pair<Stage, TissueState>>;

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A checkpoint, and the journal cut to what belongs to it.
struct Resumption {
  RunCheckpoint checkpoint;
  TrajectoryWriter writer;
};

/// The newest good checkpoint of request.directory; `problems` says what was wrong with those that could not be used.
/// Throws InputError when it belongs to another configuration or another process works on the run.
std::optional<Resumption> find_resumption(const RunRequest& request, std::vector<std::string>& problems);

class WoundClosureRun {
 public:
  /// From the beginning, or from a saved stage.
  WoundClosureRun(const RunRequest& request, SavedStage start);
  WoundClosureRun(const RunRequest& request, Resumption resumption);
  RunOutcome run();

 private:
  using SavedProgress = decltype(RunCheckpoint::progress);
  WoundClosureRun(const RunRequest& request, TrajectoryWriter writer);
  void prepare();
  void close_wound();
  void run_closure_stage(TissueState& last_good);
  bool stop_requested() const { return request_.stop && request_.stop(); }
  bool checkpoint_due() const;
  bool is_to_be_written(SavePoint point) const;
  void save(SavedProgress progress, double time, SavePoint point);
  void remove_old_outputs() const;
  void begin_stage(const char* name);
  std::map<std::string, double> wall_so_far() const;
  void report(std::string_view stage, double fraction, std::string_view text);
  void publish();

  const RunRequest& request_;
  const Config& config_;
  TrajectoryWriter writer_;
  RunRecorder recorder_;
  SavedStage start_;
  std::optional<SavedProgress> resumed_;
  bool fresh_ = true;
  RunOutcome outcome_;
  TissueState prepared_;
  std::string stage_;  ///< for wall_s
  Stopwatch stage_watch_, run_watch_, saved_watch_;
  RunStatusNote note_;
  double noted_ = 0.0, first_fraction_ = 0.0, stage_begun_ = 0.0;  ///< for status.json
};

}  // namespace suture
