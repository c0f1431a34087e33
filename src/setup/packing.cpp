#include "suture/setup/packing.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "setup/energy_options.hpp"
#include "suture/errors.hpp"
#include "suture/physics/confinement.hpp"
#include "suture/setup/placement.hpp"

namespace suture {

namespace {

constexpr double pi = std::numbers::pi;

double covered_area(double area, double perimeter, double half_membrane) {
  return area + perimeter * half_membrane + pi * half_membrane * half_membrane;
}

/// Area a cell covers at rest.
double rest_covered_area(const Tissue& tissue, int cell, double half_membrane) {
  double perimeter = 0.0;
  for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) perimeter += tissue.initial_rest_length(v);
  return covered_area(tissue.material(cell).rest_area, perimeter, half_membrane);
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
                                    double wall_radius) {
  std::vector<double> disc_radii, corner_radii;
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    const double corners = tissue.vertex_count(cell);
    disc_radii.push_back(std::sqrt(rest_covered_area(tissue, cell, half_membrane) / pi));
    corner_radii.push_back(std::sqrt(2.0 * tissue.material(cell).rest_area / (corners * std::sin(2.0 * pi / corners))));
  }
  RandomStream centres(config.tissue.seed, RandomPurpose::centres);
  const DiscPlacement placement = spread_discs(disc_radii, wall_radius, centres);
  // Membranes may be pressed together by half a membrane at most: beyond that they could cross.
  const double shrink = std::max(0.0, placement.deepest_overlap - half_membrane);
  for (double& radius : corner_radii) {
    radius -= shrink;
    if (!(radius > 0.0))
      throw InputError(fmt::format("packing.initial_fraction: {} leaves no room to place {} cells at random",
                                   config.packing.initial_fraction, tissue.cell_count()));
  }
  RandomStream shapes(config.tissue.seed, RandomPurpose::shapes);
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
  if (!(packing.initial_fraction > 0.0 && packing.initial_fraction < packing.final_fraction))
    throw InputError(fmt::format("packing.initial_fraction: {} is not between 0 and packing.final_fraction = {}",
                                 packing.initial_fraction, packing.final_fraction));
  if (!(packing.increment > 0.0))
    throw InputError(fmt::format("packing.increment: {} is not positive", packing.increment));
}

}  // namespace

double covered_area(const TissueState& state, double half_membrane) {
  const StateView view = state.view();
  double covered = 0.0;
  for (int cell = 0; cell < state.tissue.cell_count(); ++cell) {
    double area = 0.0, perimeter = 0.0;
    for (int v = state.tissue.first_vertex(cell); v < state.tissue.end_vertex(cell); ++v) {
      const int w = state.tissue.next(v);
      area += 0.5 * (view.x[v] * view.y[w] - view.x[w] * view.y[v]);
      perimeter += std::hypot(view.x[w] - view.x[v], view.y[w] - view.y[v]);
    }
    covered += covered_area(area, perimeter, half_membrane);
  }
  return covered;
}

Packing make_packing(const Config& config, const Progress& progress) {
  const PackingParameters& options = config.packing;
  check(options);
  const Tissue tissue = make_tissue(config);
  const double contact = contact_distance(config), half_membrane = 0.5 * contact;
  const TissueOdeOptions ode_options = elastic_options(config, options.adhesion);

  Packing packing;
  TissueState& state = packing.state;
  state.tissue = packing_tissue(tissue, options);
  double covered = 0.0;
  for (int cell = 0; cell < tissue.cell_count(); ++cell) covered += rest_covered_area(tissue, cell, half_membrane);
  packing.wall_radius = std::sqrt(covered / (pi * options.initial_fraction));
  state.values = random_polygons(config, tissue, half_membrane, packing.wall_radius);
  state.values.insert(state.values.end(), tissue.initial_rest_lengths().begin(), tissue.initial_rest_lengths().end());

  Fire fire(state.layout().positions());
  const FireOptions fire_settings = fire_options(state.tissue, ode_options.contact, options.force_tolerance, options.maximum_iterations);
  while (true) {
    const auto wall = std::make_shared<Confinement>(0.0, 0.0, packing.wall_radius, options.wall_range * contact,
                                                    options.wall_energy, tissue.vertex_count());
    TissueOde ode(state.tissue, 0, ode_options, {wall});
    const FireReport minimised = minimise_energy(fire, ode, state, fire_settings);
    packing.report.iterations += minimised.iterations;
    packing.report.largest_force = minimised.largest_force;
    packing.report.fraction = covered_area(state, half_membrane) / (pi * packing.wall_radius * packing.wall_radius);
    report_progress(progress, "packing",
                    (packing.report.fraction - options.initial_fraction) /
                        (options.final_fraction - options.initial_fraction),
                    fmt::format("packing fraction {:.4f}, {} iterations, largest force {:.1e}", packing.report.fraction,
                                minimised.iterations, minimised.largest_force));
    if (packing.report.fraction >= options.final_fraction-1e-4 ) break;
    const double target = std::min(packing.report.fraction + options.increment, options.final_fraction);
    const double factor = std::sqrt(packing.report.fraction / target);
    packing.wall_radius *= factor;
    draw_in(state, factor);
    ++packing.report.compression_steps;
    if(packing.report.compression_steps>100) break;
  }
  state.tissue = tissue;
  return packing;
}

}  // namespace suture
