// Runs a sweep in child processes, a run in each, so that a crash is a failed run and not the end of the sweep.
#pragma once

#include <functional>
#include <string>

#include "suture/sweep/sweep_run.hpp"

namespace suture {

struct SweepProgress {
  int total = 0;             ///< runs of the sweep
  int finished_before = 0;   ///< when this process began
  int finished = 0;          ///< now, by whomever
  int failed = 0;            ///< of those
  int running = 0;           ///< by this process
  std::string last;          ///< what ended last, for a person; empty if nothing did since the previous report
};

struct PoolOptions {
  int jobs = 1;
  std::function<void(const SweepProgress&)> progress;  ///< about once a second and when a run ends; may be empty
  std::function<bool()> stop;                          ///< asked several times a second; may be empty
};

/// Executes every run that is not finished; waits for those that other workers have. A child that is killed from outside (out of
/// memory, a batch system) is repeated twice before its run counts as failed; one that crashes fails at once. Returns
/// false when it was stopped: children have ended then, what they were doing is given back. For single-threaded callers only: it
/// forks. Throws FileError when results cannot be written.
bool execute_sweep(const SweepFolder& folder, const SweepPlan& plan, const PoolOptions& options);

}  // namespace suture
