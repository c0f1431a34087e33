#include "suture/setup/fire.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "suture/errors.hpp"

namespace suture {

namespace {

/// Sums are kept in fixed lanes: the compiler can vectorise them without being allowed to reorder additions.
constexpr std::size_t lanes = 8;
using Lanes = std::array<double, lanes>;

double sum(const Lanes& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
double maximum(const Lanes& values) { return *std::max_element(values.begin(), values.end()); }

/// Calls body(lane, i) for every i in [0, size).
template <typename Body>
void for_each_in_lanes(std::size_t size, Body&& body) {
  const std::size_t whole = size - size % lanes;
  for (std::size_t i = 0; i < whole; i += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) body(lane, i + lane);
  for (std::size_t i = whole; i < size; ++i) body(i - whole, i);
}

struct Products {
  double power, speed_squared, force_squared, largest_force;
};

Products products(std::span<const double> velocity, std::span<const double> gradient) {
  Lanes power{}, speed_squared{}, force_squared{}, largest_force{};
  for_each_in_lanes(velocity.size(), [&](std::size_t lane, std::size_t i) {
    power[lane] -= velocity[i] * gradient[i];
    speed_squared[lane] += velocity[i] * velocity[i];
    force_squared[lane] += gradient[i] * gradient[i];
    const double magnitude = std::abs(gradient[i]);
    largest_force[lane] = largest_force[lane] < magnitude ? magnitude : largest_force[lane];
  });
  return {sum(power), sum(speed_squared), sum(force_squared), maximum(largest_force)};
}

/// v += dt F, then v turned towards F by the mixing, keeping |v|; returns the largest component of v.
double turn_velocity(std::span<double> velocity, std::span<const double> gradient, const Products& p, double time_step,
                     double mixing) {
  const double speed =
      std::sqrt(std::max(0.0, p.speed_squared + time_step * (2.0 * p.power + time_step * p.force_squared)));
  const double keep = 1.0 - mixing;
  const double push = keep * time_step + mixing * speed / std::sqrt(p.force_squared);
  Lanes largest{};
  for_each_in_lanes(velocity.size(), [&](std::size_t lane, std::size_t i) {
    velocity[i] = keep * velocity[i] - push * gradient[i];
    const double magnitude = std::abs(velocity[i]);
    largest[lane] = largest[lane] < magnitude ? magnitude : largest[lane];
  });
  return maximum(largest);
}

void add_scaled(std::span<double> q, double factor, std::span<const double> velocity) {
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += factor * velocity[i];
}

}  // namespace

Fire::Fire(std::size_t size) : state_{.velocity = std::vector<double>(size)}, gradient_(size) {}

void Fire::restore(FireState state) {
  SUTURE_EXPECTS(state.velocity.size() == gradient_.size());
  state_ = std::move(state);
  restored_ = true;
}

FireReport Fire::minimise(std::span<double> q, const GradientFunction& gradient, const FireOptions& options,
                          const std::function<void()>& between_steps) {
  std::vector<double>& velocity = state_.velocity;
  SUTURE_EXPECTS(q.size() == velocity.size());
  if (!std::exchange(restored_, false)) {
    std::fill(velocity.begin(), velocity.end(), 0.0);
    state_.time_step = options.initial_time_step, state_.mixing = options.initial_mixing;
    state_.downhill_steps = 0, state_.report = {};
  }
  FireReport& report = state_.report;
  if (gradient(q, gradient_) != Evaluation::ok)
    throw NumericalError("FIRE: the forces cannot be computed at the starting configuration");
  const auto stop = [&] {
    ++report.uphill_stops;
    state_.downhill_steps = 0;
    state_.mixing = options.initial_mixing;
    state_.time_step = std::max(state_.time_step * options.time_step_cut, options.minimum_time_step);
    std::fill(velocity.begin(), velocity.end(), 0.0);
  };
  while (true) {
    Products p = products(velocity, gradient_);
    report.largest_force = p.largest_force;
    report.converged = report.largest_force < options.force_tolerance;
    if (report.converged || report.iterations >= options.maximum_iterations) return report;
    if (between_steps) between_steps();
    ++report.iterations;

    if (p.power > 0.0) {
      if (++state_.downhill_steps > options.delay) {
        state_.time_step = std::min(state_.time_step * options.time_step_growth, options.maximum_time_step);
        state_.mixing *= options.mixing_decay;
      }
    } else if (p.speed_squared > 0.0) {
      add_scaled(q, -0.5 * state_.time_step, velocity);
      stop();
      p.power = p.speed_squared = 0.0;
    }
    const double largest_velocity = turn_velocity(velocity, gradient_, p, state_.time_step, state_.mixing);
    const double step = std::min(state_.time_step, options.maximum_displacement / largest_velocity);
    add_scaled(q, step, velocity);
    if (gradient(q, gradient_) != Evaluation::ok) {
      add_scaled(q, -step, velocity);
      stop();
      if (gradient(q, gradient_) != Evaluation::ok)
        throw NumericalError("FIRE: the forces cannot be computed where they could be a step earlier");
    }
  }
}

}  // namespace suture
