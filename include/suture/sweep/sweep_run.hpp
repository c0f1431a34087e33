// One run of a sweep: claimed, executed, marked as finished.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "suture/sweep/plan.hpp"

namespace suture {

/// DIR of a sweep, shared by any number of workers:
///     runs/KEY/      the files of a run (those of `suture run`), config.toml and, written last, done.json
///     prepared/      tissues shared by several runs
///     claims/        who is working on what
struct SweepFolder {
  std::filesystem::path root;
  double lease_s = 300.0;  ///< a worker on another machine without a sign of life for so long counts as dead

  std::filesystem::path run(const SweepRun& run) const { return root / "runs" / run.key; }
  std::filesystem::path prepared() const { return root / "prepared"; }
  std::filesystem::path claims() const { return root / "claims"; }
  /// Creates the folders. Throws FileError.
  void create() const;
};

/// What done.json says.
struct RunRecord {
  std::string status;  ///< closed, reached_t_end or failed
  std::string reason;  ///< why it failed
  std::string commit;  ///< of the program that made it
};

/// Empty while the run has not been finished. Throws FileError when the folder holds another configuration with the same hash.
std::optional<RunRecord> finished_record(const SweepFolder& folder, const SweepRun& run);

/// Marks a run as failed without running it (its process crashed).
void record_failure(const SweepFolder& folder, const SweepRun& run, const std::string& reason);

enum class RunEnd {
  finished,  ///< now or before; failures count: done.json says so
  stopped,   ///< `stop` said so; nothing is kept
  busy,      ///< another worker has it
};

/// Executes `run` unless it is finished or somebody else works on it. What an interrupted attempt left in its folder is removed
/// first. Bad input and numerical failures are recorded, not thrown. Throws FileError.
RunEnd execute_run(const SweepFolder& folder, const SweepRun& run, const std::function<bool()>& stop);

}  // namespace suture
