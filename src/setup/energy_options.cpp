#include "setup/energy_options.hpp"

#include <algorithm>
#include <cmath>

namespace suture {

double contact_distance(const Config& config) {
  return config.contact.distance ? *config.contact.distance : make_tissue(config).mean_initial_rest_length();
}

TissueOdeOptions elastic_options(const Config& config, double adhesion) {
  TissueOdeOptions options;
  options.membrane_law = config.membrane.law;
  options.contact = config.contact;
  options.contact.distance = contact_distance(config);
  options.contact.adhesion = adhesion;
  options.plastic = false;
  options.skin = config.integrator.skin * make_tissue(config).mean_initial_rest_length();
  options.threads = config.integrator.threads;
  return options;
}

double fastest_time(const Tissue& tissue, const ContactParameters& contact) {
  // A chain of springs k/l0^2 has curvature up to 4 k/l0^2, bending up to 16 k_b/l0^2. A vertex feels the segments it
  // touches and the vertices that touch its own segments: about four contacts of curvature 2e/s^2.
  const double contacts = 8.0 * contact.energy / (*contact.distance * *contact.distance);
  double largest = 0.0;
  for (int v = 0; v < tissue.vertex_count(); ++v) {
    const CellMaterial& material = tissue.material(tissue.cell_of(v));
    const double length = tissue.initial_rest_length(v);
    const double membrane = (4.0 * material.membrane_stiffness + 16.0 * material.bending_stiffness) / (length * length);
    largest = std::max(largest, membrane + contacts);
  }
  return 1.0 / std::sqrt(largest);
}

FireOptions fire_options(const Tissue& tissue, const ContactParameters& contact, double force_tolerance,
                         int maximum_iterations) {
  const double time = fastest_time(tissue, contact);
  return {.force_tolerance = force_tolerance,
          .maximum_iterations = maximum_iterations,
          .initial_time_step = 0.25 * time,
          .maximum_time_step = 1.1 * time,
          .minimum_time_step = 0.01 * time,
          .maximum_displacement = 0.1 * *contact.distance};
}

FireReport minimise_energy(Fire& fire, TissueOde& ode, TissueState& state, const FireOptions& options,
                           const std::function<void()>& between_steps) {
  const StateLayout layout = state.layout();
  const auto gradient = [&](std::span<const double> q, std::span<double> out) {
    StateView view;
    view.x = q.first(layout.points()), view.y = q.last(layout.points());
    view.rest_length = std::span<const double>(state.values).subspan(layout.positions());
    MutableStateView slope;
    slope.x = out.first(layout.points()), slope.y = out.last(layout.points());
    return ode.gradient(state.time, view, slope);
  };
  return fire.minimise(std::span(state.values).first(layout.positions()), gradient, options, between_steps);
}

}  // namespace suture
