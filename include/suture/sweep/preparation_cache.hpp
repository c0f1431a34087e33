// Packings shared between the runs of a sweep: what happens before the closure depends on only some keys, so it is done
// once for all runs that agree in them. A run that starts from the cache gives the same wound.csv bit for bit (tested).
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "suture/model/parameters.hpp"

namespace suture {

/// Whether a run of `config` can start from a shared preparation: a wound closure from the beginning, without
/// [[cell_type]] (a saved state does not say of which type a cell is).
bool can_share_preparation(const Config& config);

/// `config` with every key at its default that the stages before the closure do not read: preset, [purse_string], [plasticity],
/// [run], [output], [units], [compression], [dipole] and [integrator] except skin and threads. A key that is
/// not named here counts as one that matters.
Config preparation_config(const Config& config);

/// The file in `folder` with the tissue at the end of the ablation stage of `config`; made if it is not there yet, by one
/// process only, the others wait. `stop` is asked while preparing and waiting. Throws NumericalError, FileError, and
/// PreparationStopped when asked to stop.
std::filesystem::path shared_preparation(const Config& config, const std::filesystem::path& folder, double lease_s,
                                         const std::function<bool()>& stop);

struct PreparationStopped {};

}  // namespace suture
