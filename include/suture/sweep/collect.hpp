// What a sweep came to: sweep.csv (one row per run), nodes.csv (one row per parameter point) and sweep.h5 (the series).
// docs/reference/output-format.md describes them.
#pragma once

#include "suture/sweep/sweep_run.hpp"

namespace suture {

/// Writes the three files into folder.root from the runs that are finished. nodes.csv and sweep.h5 depend on the results of the
/// runs only, not on when, where or in what order they were made. Throws FileError, InputError for a damaged result.
void collect_sweep(const SweepFolder& folder, const SweepPlan& plan);

}  // namespace suture
