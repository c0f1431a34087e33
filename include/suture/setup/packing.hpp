// Stage 1 of the protocol: cells placed at random in a circular wall and compressed in small steps, each followed by an
// energy minimisation (model.md section 6; Ton et al. 2023, supplement section II).
#pragma once

#include <cstdint>
#include <optional>

#include "suture/model/parameters.hpp"
#include "suture/model/state.hpp"
#include "suture/setup/fire.hpp"
#include "suture/setup/progress.hpp"
#include "suture/setup/step_watch.hpp"

namespace suture {

struct PackingReport {
  double fraction = 0.0;       ///< packing fraction reached
  double largest_force = 0.0;  ///< largest force component after the last minimisation
  int compression_steps = 0;
  std::int64_t iterations = 0;  ///< of FIRE
};

struct Packing {
  TissueState state;         ///< with the materials of the run, not those used while packing
  double wall_radius = 0.0;  ///< of the circular wall around the origin
  PackingReport report;
};

/// A packing on its way.
struct CompressionState {
  Packing packing;                       ///< with the materials used while packing
  double before = 0.0, asked = 0.0;      ///< packing fraction before the last step, and the rise it asked for
  double response = 1.0;                 ///< what such a step gains of what it asks for
  double progress_mark = 0.0;            ///< packing fraction when progress was last judged
  bool finishing = false;                ///< in the last minimisation, to the finer tolerance
  std::optional<FireState> minimisation; ///< empty: at its start
};

/// Packs the tissue `config` describes. The same config and attempt give the same bits; another attempt draws other
/// random numbers from the same seed. Throws InputError when the fractions make no sense, NumericalError when a
/// minimisation does not converge or the cells give way before the final fraction.
Packing make_packing(const Config& config, const Progress& progress = {}, int attempt = 0,
                     const StepWatch<CompressionState>& watch = {});

}  // namespace suture
