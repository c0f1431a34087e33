// What a finished run left on disk, as far as the tables of a sweep need it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "suture/io/wound_csv.hpp"
#include "suture/sweep/sweep_run.hpp"

namespace suture {

struct RunResult {
  const SweepRun* run = nullptr;
  std::optional<RunRecord> record;  ///< empty: not finished
  nlohmann::json summary;           ///< of summary.json; null if there is none
  WoundColumns wound;               ///< empty for a run without a closure

  bool valid() const { return record && record->status != "failed"; }
  bool closed() const { return record && record->status == "closed"; }
  /// A number of the summary; empty where it is null or absent.
  std::optional<double> number(const std::string& name) const;
};

/// Throws InputError for files that are damaged.
RunResult read_result(const SweepFolder& folder, const SweepRun& run);

}  // namespace suture
