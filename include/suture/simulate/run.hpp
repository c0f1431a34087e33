// A configuration in, a finished run on disk out: the composition root, the only place that knows all parts.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "suture/io/provenance.hpp"
#include "suture/io/summary.hpp"
#include "suture/model/parameters.hpp"
#include "suture/setup/progress.hpp"

namespace suture {

struct RunRequest {
  Config config;
  Provenance provenance;            ///< config_text, command_line filled in by the caller
  std::filesystem::path directory;  ///< created if absent
  Progress progress;                ///< may be empty
  std::function<bool()> stop;       ///< asked after every step; may be empty
  bool resume = false;              ///< go on from the newest good checkpoint in `directory`, if there is one
};

/// What a folder holds before a run.
enum class DirectoryContent {
  nothing,     ///< no run, or one of another kind of protocol
  unfinished,  ///< a run that was stopped or killed, or that another process is working on
  finished,
};
DirectoryContent content_of(const std::filesystem::path& directory);

/// Removes the checkpoints and status.json that a program killed at the very end leaves beside a finished run.
void remove_leftovers(const std::filesystem::path& directory);

/// Removes the pictures of an earlier run (final.*, strip.png, frame_*.png), of which the next may make fewer. Throws nothing.
void remove_pictures(const std::filesystem::path& directory);

struct RunOutcome {
  RunSummary summary;
  std::string failure;  ///< why the run failed; empty unless summary.status is failed
};

/// Runs the protocol of `request.config` and writes run.h5, summary.json, wound.csv, final.png, final.svg, strip.png and
/// frame_*.png (one-cell experiments: cell.csv instead of wound.csv, no strip). While it goes on, DIR holds run.journal,
/// checkpoint, checkpoint.previous and status.json; after a stop they stay, so that a later call with `resume` goes on.
/// A numerical failure is not thrown: what was computed is written and the outcome says why. Throws InputError for a bad
/// start file, for a checkpoint of another configuration and when no checkpoint is usable, FileError when the output
/// cannot be written (what was written before stays readable).
RunOutcome run_protocol(const RunRequest& request);

}  // namespace suture
