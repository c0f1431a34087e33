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
  std::function<bool()> stop;       ///< asked after every sample; may be empty
};

struct RunOutcome {
  RunSummary summary;
  std::string failure;  ///< why the run failed; empty unless summary.status is failed
};

/// Runs the protocol of `request.config` and writes run.h5, summary.json, wound.csv, final.png, final.svg, strip.png and
/// frame_*.png (one-cell experiments: cell.csv instead of wound.csv, no strip). A numerical failure is not thrown: what was computed is written and the outcome says why.
/// Throws InputError for a bad start file, FileError when the output cannot be written.
RunOutcome run_protocol(const RunRequest& request);

}  // namespace suture
