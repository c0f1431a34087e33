// The tissues that are measured, and a short way to integrate one with its ring but without events.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "report.hpp"
#include "suture/integrate/integrator.hpp"
#include "suture/model/parameters.hpp"
#include "suture/model/state.hpp"
#include "suture/ode/tissue_ode.hpp"

namespace suture::benchmark {

/// A packing of `cells` cells of `vertices` points, with adhesion on, and the configuration that made it. `rough`: compressed in
/// few steps and hardly relaxed, as is enough for measuring kernels and makes many vertices affordable.
struct Packed {
  Config config;
  TissueState state;
  double seconds = 0.0;  ///< that packing took
};
Packed packed_tissue(int cells, int vertices, bool rough = false);

/// Shifted copies of a packed disc, side by side without touching, `copies` in all.
TissueState tiled(const TissueState& patch, int copies, double contact_distance);

/// `cells` regular hexagons of area 1 at the contact distance from each other, those 19 in the middle left out, relaxed
/// without a string.
Packed honeycomb_with_wound(int cells, int vertices, double relaxation_time);

/// A relaxed wound: examples/embryo.toml (50 cells less 5) or, for a smoke test, examples/small.toml. vertices (per cell), seed:
/// if not as in the example.
Packed wounded_tissue(bool small, std::optional<int> vertices = {}, std::optional<std::uint64_t> seed = {});

/// The same wound with a purse string on it and the given material: smooth as long as no event is processed.
TissueState with_ring(const Config& config, const TissueState& wounded);
/// Sets k_a and tau in the configuration and in the material of every cell.
void set_material(Packed& problem, double area_stiffness, double tau);
/// Gives every cell the material of the configuration.
void set_material(Packed& problem);

std::unique_ptr<TissueOde> make_ode(const Config& config, const TissueState& state);

/// y at `end` and the counts, from state.values at state.time = 0.
struct Integrated {
  std::vector<double> y;
  Statistics statistics;
};
Integrated integrate(const Config& config, const TissueState& state, const IntegratorOptions& options, double end);

/// Adaptive (tolerance in l0) or fixed-step (step in model units) options for `state`.
IntegratorOptions with_tolerance(Method method, double tolerance, const TissueState& state);
IntegratorOptions with_step(Method method, double step, const TissueState& state);

/// Errors of the cell vertices' positions against y_reference, in l0: root mean square over coordinates, largest.
struct PositionErrors {
  double rms = 0.0, largest = 0.0;
};
PositionErrors position_errors(const TissueState& state, const std::vector<double>& y, const std::vector<double>& y_reference);

void append_counts(Measurement& measurement, const Statistics& counts);

}  // namespace suture::benchmark
