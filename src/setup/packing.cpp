#include "suture/setup/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "setup/energy_options.hpp"
#include "suture/errors.hpp"
#include "suture/measure/patch.hpp"
#include "suture/physics/confinement.hpp"
#include "suture/setup/placement.hpp"
#include "threads/ranges.hpp"

namespace suture {

namespace {

constexpr double pi = std::numbers::pi;

/// Area a cell covers at rest, its half membrane included.
double rest_covered_area(const Tissue& tissue, int cell, double half_membrane) {
  double perimeter = 0.0;
  for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) perimeter += tissue.initial_rest_length(v);
  return tissue.material(cell).rest_area + perimeter * half_membrane + pi * half_membrane * half_membrane;
}

Tissue packing_tissue(const Tissue& tissue, const PackingParameters& packing) {
  std::vector<CellMaterial> materials;
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    CellMaterial material = tissue.material(cell);
    material.area_stiffness = packing.area_stiffness;
    material.bending_stiffness = packing.bending_stiffness;
    materials.push_back(material);
  }
  return tissue.with_materials(std::move(materials));
}

/// Polygons at random places inside the wall, too small to cross each other.
std::vector<double> random_polygons(const Config& config, const Tissue& tissue, double half_membrane,
                                    double wall_radius, int attempt) {
  std::vector<double> disc_radii, corner_radii;
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    const double corners = tissue.vertex_count(cell);
    disc_radii.push_back(std::sqrt(rest_covered_area(tissue, cell, half_membrane) / pi));
    corner_radii.push_back(std::sqrt(2.0 * tissue.material(cell).rest_area / (corners * std::sin(2.0 * pi / corners))));
  }
  RandomStream centres(config.tissue.seed, RandomPurpose::centres, attempt);
  DiscPlacement placement = spread_discs(disc_radii, wall_radius, centres);
  if (tissue.vertex_count() >= divided_from_vertices) number_along_curve(tissue, placement);
  // Membranes may be pressed together by half a membrane at most: beyond that they could cross.
  const double shrink = std::max(0.0, placement.deepest_overlap - half_membrane);
  for (double& radius : corner_radii) {
    radius -= shrink;
    if (!(radius > 0.0))
      throw InputError(fmt::format("packing.initial_fraction: {} leaves no room to place {} cells at random",
                                   config.packing.initial_fraction, tissue.cell_count()));
  }
  RandomStream shapes(config.tissue.seed, RandomPurpose::shapes, attempt);
  return regular_polygons(tissue, placement, corner_radii, config.packing.shape_noise, shapes);
}

/// Moves every cell rigidly towards the centre of the wall.
void draw_in(TissueState& state, double factor) {
  const MutableStateView view = state.mutable_view();
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell) {
    const int first = state.tissue.first_vertex(cell), end = state.tissue.end_vertex(cell);
    double x = 0.0, y = 0.0;
    for (int v = first; v < end; ++v) x += view.x[v], y += view.y[v];
    x *= (factor - 1.0) / (end - first), y *= (factor - 1.0) / (end - first);
    for (int v = first; v < end; ++v) view.x[v] += x, view.y[v] += y;
  }
}

void check(const PackingParameters& packing) {
  if (!(packing.initial_fraction > 0.0 && packing.initial_fraction <= packing.final_fraction))
    throw InputError(fmt::format("packing.initial_fraction: {} is not between 0 and packing.final_fraction = {}",
                                 packing.initial_fraction, packing.final_fraction));
  if (!(packing.increment > 0.0))
    throw InputError(fmt::format("packing.increment: {} is not positive", packing.increment));
}

/// The wall is drawn in and the cells follow.
class Compression {
 public:
  Compression(const Config& config, const Tissue& tissue, int attempt, const Progress& progress,
              const StepWatch<CompressionState>& watch)
      : options_(config.packing),
        membrane_{.contact_distance = contact_distance(config), .range = config.contact.range},
        ode_options_(elastic_options(config, config.packing.adhesion)),
        progress_(progress),
        watch_(watch),
        fire_(2 * static_cast<std::size_t>(tissue.vertex_count())) {
    if (watch.resumed)
      resume(*watch.resumed);
    else
      place(config, tissue, attempt);
  }

  Packing run() {
    const double enough = options_.final_fraction - 0.02 * options_.increment;
    constexpr int patience = 10;
    const PackingReport& report = now_.packing.report;
    while (true) {
      minimise(now_.finishing ? options_.force_tolerance : options_.step_tolerance);
      if (now_.finishing) return std::move(now_.packing);
      if (report.compression_steps == 0) {
        now_.progress_mark = report.fraction;
      } else if (report.compression_steps % patience == 0) {
        if (report.fraction < std::min(enough, now_.progress_mark + 0.1 * options_.increment)) refuse();
        now_.progress_mark = report.fraction;
      }
      if (report.fraction < enough)
        compress();
      else
        now_.finishing = true;
    }
  }

 private:
  void place(const Config& config, const Tissue& tissue, int attempt) {
    TissueState& state = now_.packing.state;
    state.tissue = packing_tissue(tissue, options_);
    double covered = 0.0;
    for (int cell = 0; cell < tissue.cell_count(); ++cell)
      covered += rest_covered_area(tissue, cell, membrane_.half_width());
    now_.packing.wall_radius = std::sqrt(covered / (pi * options_.initial_fraction));
    state.values = random_polygons(config, tissue, membrane_.half_width(), now_.packing.wall_radius, attempt);
    state.values.insert(state.values.end(), tissue.initial_rest_lengths().begin(), tissue.initial_rest_lengths().end());
  }

  void resume(CompressionState saved) {
    if (saved.minimisation) fire_.restore(*std::move(saved.minimisation));
    in_minimisation_ = saved.minimisation.has_value();
    saved.minimisation.reset();
    now_ = std::move(saved);
  }

  CompressionState state_within_minimisation() const {
    CompressionState state = now_;
    state.minimisation = fire_.state();
    return state;
  }

  /// One step of the wall. The cells give way by shrinking and folding, so a step gains less than it asks for; the last
  /// ones ask for more by what the step before it lacked.
  void compress() {
    PackingReport& report = now_.packing.report;
    constexpr double least_response = 0.1;
    if (report.compression_steps > 0)
      now_.response = std::clamp((report.fraction - now_.before) / now_.asked, least_response, 1.0);
    now_.before = report.fraction;
    now_.asked = std::min(options_.increment, (options_.final_fraction - now_.before) / now_.response);
    const double factor = std::sqrt(now_.before / (now_.before + now_.asked));
    now_.packing.wall_radius *= factor;
    draw_in(now_.packing.state, factor);
    ++report.compression_steps;
  }

  void minimise(double force_tolerance) {
    TissueState& state = now_.packing.state;
    // A new list of contacts and a velocity of zero: nothing carries over from the minimisation before.
    if (!std::exchange(in_minimisation_, false)) watch_.offer(SavePoint::natural, [this] { return now_; });
    const auto wall =
        std::make_shared<Confinement>(0.0, 0.0, now_.packing.wall_radius, options_.wall_range * membrane_.contact_distance,
                                      options_.wall_energy, state.tissue.vertex_count());
    TissueOde ode(state.tissue, 0, ode_options_, {wall});
    const auto between_steps = [this] {
      if (watch_.is_due()) watch_.offer(SavePoint::between, [this] { return state_within_minimisation(); });
    };
    const FireReport minimised =
        minimise_energy(fire_, ode, state,
                        fire_options(state.tissue, ode_options_.contact, force_tolerance, options_.maximum_iterations),
                        between_steps);
    PackingReport& report = now_.packing.report;
    report.iterations += minimised.iterations;
    report.largest_force = minimised.largest_force;
    report.fraction = packing_fraction(state.tissue, state.view(), membrane_, now_.packing.wall_radius);
    // A finished packing that lacks the last digits is as good as those on the way to it: the anneal stirs everything again.
    const bool nearly = now_.finishing && minimised.largest_force <= options_.step_tolerance;
    if (!minimised.converged && !nearly)
      throw NumericalError(fmt::format(
          "packing: at packing fraction {:.4f} the largest force is still {:.2g} after {} iterations of FIRE; raise "
          "packing.maximum_iterations or the tolerance {:g}",
          report.fraction, minimised.largest_force, minimised.iterations, force_tolerance));
    const double range = options_.final_fraction - options_.initial_fraction;
    report_progress(progress_, "packing",
                    range > 0.0 && !now_.finishing ? std::clamp((report.fraction - options_.initial_fraction) / range, 0.0, 0.99) : 1.0,
                    fmt::format("packing fraction {:.4f}, {} iterations, largest force {:.1e}{}", report.fraction, minimised.iterations,
                                minimised.largest_force, minimised.converged ? "" : " (accepted above packing.force_tolerance)"));
  }

  [[noreturn]] void refuse() const {
    throw NumericalError(
        fmt::format("packing: the cells give way at packing fraction {:.4f} and cannot be compressed to "
                    "packing.final_fraction = {}; lower it or raise packing.area_stiffness",
                    now_.packing.report.fraction, options_.final_fraction));
  }

  const PackingParameters& options_;
  Membrane membrane_;
  TissueOdeOptions ode_options_;
  const Progress& progress_;
  const StepWatch<CompressionState>& watch_;
  Fire fire_;
  CompressionState now_;
  bool in_minimisation_ = false;  ///< resumed within one
};

}  // namespace

Packing make_packing(const Config& config, const Progress& progress, int attempt,
                     const StepWatch<CompressionState>& watch) {
  check(config.packing);
  const Tissue tissue = make_tissue(config);
  Packing packing = Compression(config, tissue, attempt, progress, watch).run();
  packing.state.tissue = tissue;
  return packing;
}

}  // namespace suture
