#include "suture/setup/dynamics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "setup/energy_options.hpp"
#include "suture/errors.hpp"
#include "suture/setup/random.hpp"

namespace suture {

namespace {

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double kinetic_energy(std::span<const double> velocities) {
  double sum = 0.0;
  for (const double velocity : velocities) sum += velocity * velocity;
  return 0.5 * sum;
}

void remove_momentum(std::span<double> velocities) {
  const double drift = mean(velocities);
  for (double& velocity : velocities) velocity -= drift;
}

void remove_rotation(std::span<const double> x, std::span<const double> y, std::span<double> vx, std::span<double> vy) {
  const double centre_x = mean(x), centre_y = mean(y);
  double angular_momentum = 0.0, inertia = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - centre_x, dy = y[i] - centre_y;
    angular_momentum += dx * vy[i] - dy * vx[i];
    inertia += dx * dx + dy * dy;
  }
  const double turn = angular_momentum / inertia;
  for (std::size_t i = 0; i < x.size(); ++i) {
    vx[i] += turn * (y[i] - centre_y);
    vy[i] -= turn * (x[i] - centre_x);
  }
}

}  // namespace

std::vector<double> maxwell_velocities(const TissueState& state, double temperature, std::uint64_t seed) {
  const std::size_t count = state.tissue.vertex_count();
  const StateView view = state.view();
  std::vector<double> velocities(2 * count);
  RandomStream random(seed, RandomPurpose::velocities);
  for (double& velocity : velocities) velocity = random.normal();
  const std::span<double> vx(velocities.data(), count), vy(velocities.data() + count, count);
  remove_momentum(vx);
  remove_momentum(vy);
  remove_rotation(view.x.first(count), view.y.first(count), vx, vy);
  const double scale = std::sqrt(temperature * static_cast<double>(count) / kinetic_energy(velocities));
  for (double& velocity : velocities) velocity *= scale;
  return velocities;
}

EnergyReport move_at_constant_energy(TissueOde& ode, const TermList& energies, TissueState& state,
                                     std::vector<double>& velocities, double duration, double time_step) {
  SUTURE_EXPECTS(velocities.size() == static_cast<std::size_t>(state.layout().positions()));
  const auto steps = static_cast<long>(std::ceil(duration / time_step - 1e-9));
  const double step = steps > 0 ? duration / static_cast<double>(steps) : 0.0;
  std::vector<double> gradient(state.values.size());
  const auto evaluate = [&] {
    if (ode.gradient(state.time, state.view(), {state.layout(), gradient}) != Evaluation::ok)
      throw NumericalError(fmt::format("constant-energy motion at time {:.6g}, step {:.3g}: {}", state.time, step,
                                       ode.refusal()));
  };
  const auto kick = [&](double time) {
    for (std::size_t i = 0; i < velocities.size(); ++i) velocities[i] -= time * gradient[i];
  };
  const auto energy = [&] {
    double sum = kinetic_energy(velocities);
    for (const auto& term : energies) sum += term->energy(state.time, state.view());
    return sum;
  };

  EnergyReport report;
  report.initial = report.final = energy();
  const double start = state.time;
  const long sampling = std::max(1L, steps / 10);
  evaluate();
  for (long n = 1; n <= steps; ++n) {
    kick(0.5 * step);
    for (std::size_t i = 0; i < velocities.size(); ++i) state.values[i] += step * velocities[i];
    state.time = start + static_cast<double>(n) * step;
    evaluate();
    kick(0.5 * step);
    if (n % sampling == 0 || n == steps) {
      report.final = energy();
      report.largest_deviation = std::max(report.largest_deviation, std::abs(report.final - report.initial));
    }
  }
  return report;
}

Statistics relax_overdamped(const Config& config, TissueState& state, double duration) {
  TissueOde ode(state.tissue, 0, elastic_options(config, config.contact.adhesion), {});
  const double length = make_tissue(config).mean_initial_rest_length();
  IntegratorOptions options;
  options.method = config.integrator.method;
  options.position_tolerance = config.integrator.tolerance * length;
  options.rest_length_tolerance = config.integrator.rest_length_tolerance * length;
  options.time_step = config.integrator.time_step.value_or(0.0);
  options.maximum_order = config.integrator.maximum_order;
  const auto integrator = make_integrator(ode, options, state.time, state.values);
  const double end = state.time + duration;
  while (integrator->time() < end) integrator->step(end);
  state.values.assign(integrator->state().begin(), integrator->state().end());
  state.time = end;
  return integrator->statistics();
}

}  // namespace suture
