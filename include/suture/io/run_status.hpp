// Where a running simulation is: DIR/status.json, replaced about once a second, read by `suture status`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace suture {

struct RunStatusNote {
  std::string stage;          ///< "packing", "anneal", "ablation", "closure"
  double fraction = 0.0;      ///< of the stage done
  std::string text;           ///< one line for a person: time, wound, step
  double wall_s = 0.0;        ///< since this process started the run or took it up again
  std::optional<double> eta_s;///< until the end of the stage, if it goes on as before
  std::string state;          ///< "running" or "stopped"
  std::string updated;        ///< ISO 8601, UTC
  std::string host;
  int process = 0;
};

/// Replaces DIR/status.json as a whole, without waiting for the disk. Nothing depends on it: failures are ignored.
void write_status(const std::filesystem::path& directory, const RunStatusNote& note);
void remove_status(const std::filesystem::path& directory);

/// A few lines for a person about the run in DIR, whether it goes on, was stopped, was killed or is finished. Opens files
/// for reading only. Throws InputError when there is no run.
struct DirectoryStatus {
  std::string text;
  bool running = false;
};
DirectoryStatus describe_run(const std::filesystem::path& directory);

}  // namespace suture
