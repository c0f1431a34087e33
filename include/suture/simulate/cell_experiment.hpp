// The two experiments on one cell that show what membrane plasticity does (model.md section 8).
//
//   compression  (Ton et al. 2023, Fig. 2c)  two plates close on a round cell during compression.closing_time, are held
//                until compression.duration after the start, and are taken away; the cell is observed for
//                compression.recovery.
//   dipole       (Ton et al. 2023, supplement, Fig. S5)  vertices left of the centre of mass at the start are pulled by
//                -dipole.force in x, all others by +dipole.force, for dipole.duration.
//
// The load is an explicit function of time, and smooth within each phase; the integrator stops where a phase ends and
// is restarted there. The overdamped motion has no inertia: vertices follow the forces at once.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "suture/integrate/integrator.hpp"
#include "suture/io/cell_csv.hpp"
#include "suture/io/provenance.hpp"
#include "suture/io/summary.hpp"
#include "suture/model/parameters.hpp"
#include "suture/model/state.hpp"
#include "suture/physics/plates.hpp"
#include "suture/setup/progress.hpp"

namespace suture {

struct CellExperimentResult {
  std::vector<CellSample> samples;            ///< every output.interval, with every frame and at the end of every phase
  std::vector<TissueState> frames;            ///< every output.frame_interval, first, release and last included
  std::optional<std::size_t> release_sample;  ///< compression: when the plates are taken away
  std::optional<std::size_t> release_frame;
  std::optional<std::string> failure;  ///< why the integration ended early; everything before is valid
  Statistics statistics;
  double wall_s = 0.0;
};

/// A time during which the load is smooth. Times since the start.
struct LoadPhase {
  double start = 0.0, end = 0.0;
  std::optional<ParallelPlates> plates;  ///< of a compression, until the release
};

/// A round cell at rest: a regular polygon around the origin with an edge, not a vertex, at its top, so that a polygon
/// of even number of vertices is symmetric about both axes and none lies on the axis that divides the dipole.
/// Throws InputError unless the configuration describes one cell of shape parameter 1.
TissueState make_round_cell(const Config& config);

/// The phases of a compression (closing, holding, released; the last one only if compression.recovery > 0) or of a
/// dipole (one). Gaps are measured between the plates, diameters over the membrane: 2 (radius + range of the plates).
/// Throws InputError for Protocol::wound_closure and for plates that close more slowly than they are held.
std::vector<LoadPhase> load_phases(const Config& config, const TissueState& cell);

/// The forces of the dipole on `cell`, as x components, one per vertex.
std::vector<double> dipole_forces(const Config& config, const TissueState& cell);

/// Runs config.run.protocol. Throws InputError; a numerical failure is reported in the result instead, with everything
/// computed until then.
CellExperimentResult run_cell_experiment(const Config& config, const Progress& progress = {});

/// The summary of a finished or failed experiment. Throws InputError for a result without samples.
RunSummary summarise(const CellExperimentResult& result, const Config& config);

/// Writes run.h5, summary.json, cell.csv, final.png and final.svg into `directory`, which must exist.
/// Throws FileError.
void write_cell_experiment(const CellExperimentResult& result, const Config& config, const Provenance& provenance,
                           const std::filesystem::path& directory);

}  // namespace suture
