#include "problems.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "simulate/closure_events.hpp"
#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/measure/membrane.hpp"
#include "suture/measure/wound.hpp"
#include "suture/physics/purse_string_chain.hpp"
#include "suture/physics/purse_string_tethers.hpp"
#include "suture/setup/protocol.hpp"

namespace suture::benchmark {

Packed packed_tissue(int cells, int vertices, bool rough) {
  Packed packed;
  packed.config.tissue.cells = cells;
  packed.config.tissue.vertices = vertices;
  packed.config.run.last_stage = Stage::packing;
  if (rough) {
    packed.config.packing.increment = 0.02;
    packed.config.packing.step_tolerance = packed.config.packing.force_tolerance = 0.02;
  }
  packed.config = with_contact_distance(packed.config);
  packed.seconds = time_calls(1, [&] { packed.state = prepare_tissue(packed.config).state; }).median;
  packed.state.time = 0.0;
  return packed;
}

TissueState tiled(const TissueState& patch, int copies, double contact_distance) {
  const int vertices = patch.tissue.vertex_count(), columns = static_cast<int>(std::ceil(std::sqrt(copies)));
  const StateView view = patch.view();
  const auto [x_low, x_high] = std::minmax_element(view.x.begin(), view.x.end());
  const auto [y_low, y_high] = std::minmax_element(view.y.begin(), view.y.end());
  const double pitch = std::max(*x_high - *x_low, *y_high - *y_low) + 2.0 * contact_distance;
  std::vector<int> counts;
  std::vector<CellMaterial> materials;
  std::vector<double> rest_lengths;
  for (int copy = 0; copy < copies; ++copy) {
    for (int c = 0; c < patch.tissue.cell_count(); ++c) {
      counts.push_back(patch.tissue.vertex_count(c));
      materials.push_back(patch.tissue.material(c));
    }
    rest_lengths.insert(rest_lengths.end(), patch.tissue.initial_rest_lengths().begin(), patch.tissue.initial_rest_lengths().end());
  }
  TissueState all{.tissue = Tissue(counts, materials, rest_lengths)};
  all.values.resize(all.layout().size());
  const MutableStateView out = all.mutable_view();
  for (int copy = 0; copy < copies; ++copy)
    for (int v = 0; v < vertices; ++v) {
      const int there = copy * vertices + v;
      out.x[there] = view.x[v] + pitch * (copy % columns);
      out.y[there] = view.y[v] + pitch * (copy / columns);
      out.rest_length[there] = view.rest_length[v];
    }
  return all;
}

Packed wounded_tissue(bool small, std::optional<int> vertices, std::optional<std::uint64_t> seed) {
  Packed wounded;
  const std::string name = small ? "small" : "embryo";
  wounded.config = read_config(std::string(SUTURE_SOURCE_DIR) + "/examples/" + name + ".toml");
  wounded.config.tissue.vertices = vertices.value_or(wounded.config.tissue.vertices);
  wounded.config.tissue.seed = seed.value_or(wounded.config.tissue.seed);
  wounded.config = with_contact_distance(wounded.config);
  wounded.seconds = time_calls(1, [&] { wounded.state = prepare_tissue(wounded.config).state; }).median;
  wounded.state.time = 0.0;
  return wounded;
}

TissueState with_ring(const Config& config, const TissueState& wounded) {
  const Membrane membrane = make_membrane(config.contact, wounded.tissue);
  const std::optional<Wound> wound = find_wound(wounded.tissue, wounded.view(), membrane);
  if (!wound) throw NumericalError("the benchmark's tissue has no wound");
  return create_purse_string(wounded, string_boundary(wounded.tissue, wound->boundary, config.purse_string.crevice_depth),
                             config.purse_string, membrane.contact_distance);
}

void set_material(Packed& problem, double area_stiffness, double tau) {
  problem.config.area.stiffness = area_stiffness;
  problem.config.plasticity.tau = tau;
  set_material(problem);
}

void set_material(Packed& problem) {
  const Config& config = problem.config;
  std::vector<CellMaterial> materials;
  for (int c = 0; c < problem.state.tissue.cell_count(); ++c) {
    CellMaterial material = problem.state.tissue.material(c);
    material.area_stiffness = config.area.stiffness;
    material.membrane_stiffness = config.membrane.stiffness;
    material.bending_stiffness = config.bending.stiffness;
    material.tau = config.plasticity.tau;
    material.memory = config.plasticity.memory;
    materials.push_back(material);
  }
  problem.state.tissue = problem.state.tissue.with_materials(std::move(materials));
}

std::unique_ptr<TissueOde> make_ode(const Config& config, const TissueState& state) {
  const double contact_distance = make_membrane(config.contact, state.tissue).contact_distance;
  TissueOdeOptions options;
  options.membrane_law = config.membrane.law;
  options.contact = config.contact;
  options.contact.distance = contact_distance;
  options.skin = config.integrator.skin * state.tissue.mean_initial_rest_length();
  options.threads = config.integrator.threads;
  std::vector<std::shared_ptr<const EnergyTerm>> extra;
  if (!state.purse_string.empty()) {
    extra.push_back(std::make_shared<PurseStringChain>(state.tissue, state.purse_string, config.purse_string));
    extra.push_back(std::make_shared<PurseStringTethers>(state.tissue, state.purse_string, config.purse_string, contact_distance));
  }
  return std::make_unique<TissueOde>(state.tissue, state.purse_string.size(), options, std::move(extra), state.reference_rest_length);
}

Integrated integrate(const Config& config, const TissueState& state, const IntegratorOptions& options, double end) {
  const std::unique_ptr<TissueOde> ode = make_ode(config, state);
  const std::unique_ptr<Integrator> integrator = make_integrator(*ode, options, 0.0, state.values);
  while (integrator->time() < end) {
    const std::optional<double> kink = next_kink_time(state.purse_string, integrator->time());
    integrator->step(std::min(end, kink.value_or(end)));
  }
  return {{integrator->state().begin(), integrator->state().end()}, integrator->statistics()};
}

IntegratorOptions with_tolerance(Method method, double tolerance, const TissueState& state) {
  Config config;
  config.integrator.method = method;
  config.integrator.tolerance = config.integrator.rest_length_tolerance = tolerance;
  return integrator_options(config, state.tissue.mean_initial_rest_length());
}

IntegratorOptions with_step(Method method, double step, const TissueState& state) {
  IntegratorOptions options = with_tolerance(method, 1e-3, state);
  options.time_step = step;
  return options;
}

PositionErrors position_errors(const TissueState& state, const std::vector<double>& y, const std::vector<double>& y_reference) {
  const StateView a(state.layout(), y), b(state.layout(), y_reference);
  const int vertices = state.tissue.vertex_count();
  double sum = 0.0, largest = 0.0;
  for (int v = 0; v < vertices; ++v) {
    const double dx = a.x[v] - b.x[v], dy = a.y[v] - b.y[v];
    sum += dx * dx + dy * dy;
    largest = std::max(largest, std::hypot(dx, dy));
  }
  const double unit = state.tissue.mean_initial_rest_length();
  return {std::sqrt(sum / (2.0 * vertices)) / unit, largest / unit};
}

void append_counts(Measurement& m, const Statistics& counts) {
  const auto add = [&](const char* name, std::int64_t value) { m.values.emplace_back(name, static_cast<double>(value)); };
  add("rates", counts.rate_evaluations);
  add("steps", counts.steps);
  add("newton", counts.newton_iterations);
  add("linear", counts.linear_iterations);
  add("error_test_failures", counts.error_test_failures);
  add("convergence_failures", counts.convergence_failures);
  add("restarts", counts.restarts);
}

}  // namespace suture::benchmark
