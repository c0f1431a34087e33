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

std::vector<double> maxwell_velocities(const TissueState& state, double temperature, std::uint64_t seed, int attempt) {
  const std::size_t count = state.tissue.vertex_count();
  const StateView view = state.view();
  std::vector<double> velocities(2 * count);
  RandomStream random(seed, RandomPurpose::velocities, attempt);
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
      throw NumericalError(
          fmt::format("constant-energy motion at time {:.6g}, step {:.3g}: {}", state.time, step, ode.refusal()));
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

Statistics relax_overdamped(const Config& config, TissueState& state, double duration, const MotionProgress& progress) {
  if (!(duration > 0.0)) return {};
  TissueOde ode(state.tissue, 0, elastic_options(config, config.contact.adhesion), {});
  // Whatever integrator the closure is to be studied with, it starts from the same wound.
  Config relaxation = config;
  relaxation.integrator = {.method = Method::cvode, .tolerance = config.anneal.tolerance};
  const IntegratorOptions options = integrator_options(relaxation, make_tissue(config).mean_initial_rest_length());
  const auto integrator = make_integrator(ode, options, state.time, state.values);
  const double start = state.time, end = start + duration;
  constexpr int reports = 20;
  for (int part = 1; part <= reports; ++part) {
    const double stop = part == reports ? end : start + duration * part / reports;
    while (integrator->time() < stop) integrator->step(end);
    if (progress)
      progress(static_cast<double>(part) / reports,
               fmt::format("overdamped motion, {:.4g} of {:g}", integrator->time() - start, duration));
  }
  const auto reached = integrator->state();
  state.values.assign(reached.begin(), reached.end());
  state.time = end;
  return integrator->statistics();
}

}  // namespace suture
