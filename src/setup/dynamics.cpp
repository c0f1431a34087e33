#include "suture/setup/dynamics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

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

namespace {

class ConstantEnergyMotion {
 public:
  ConstantEnergyMotion(const MakeOde& make_ode, const TermList& energies, ConstantEnergyState initial, double duration,
                       double time_step, double checkpoint_interval, const StepWatch<ConstantEnergyState>& watch)
      : make_ode_(make_ode),
        energies_(energies),
        watch_(watch),
        checkpoint_interval_(checkpoint_interval),
        steps_(static_cast<long>(std::ceil(duration / time_step - 1e-9))),
        step_(steps_ > 0 ? duration / static_cast<double>(steps_) : 0.0),
        now_(std::move(initial)),
        gradient_(now_.state.values.size()) {
    if (now_.steps_done == 0) now_.report.initial = now_.report.final = energy();
  }

  ConstantEnergyState run() {
    double next = next_multiple(now_.start, checkpoint_interval_, now_.state.time);
    evaluate_afresh();
    while (now_.steps_done < steps_) {
      take_step();
      if (now_.state.time >= next) {
        // The list of contacts does not change the forces beyond rounding, but what goes on from a checkpoint has none.
        evaluate_afresh();
        watch_.offer(SavePoint::configured, [this] { return now_; });
        next = next_multiple(now_.start, checkpoint_interval_, now_.state.time);
      } else if (watch_.is_due()) {
        watch_.offer(SavePoint::between, [this] { return now_; });
      }
    }
    return std::move(now_);
  }

 private:
  void take_step() {
    kick(0.5 * step_);
    for (std::size_t i = 0; i < now_.velocities.size(); ++i) now_.state.values[i] += step_ * now_.velocities[i];
    ++now_.steps_done;
    now_.state.time = now_.start + static_cast<double>(now_.steps_done) * step_;
    evaluate();
    kick(0.5 * step_);
    if (now_.steps_done % std::max(1L, steps_ / 10) == 0 || now_.steps_done == steps_) {
      EnergyReport& report = now_.report;
      report.final = energy();
      report.largest_deviation = std::max(report.largest_deviation, std::abs(report.final - report.initial));
    }
  }

  void kick(double time) {
    for (std::size_t i = 0; i < now_.velocities.size(); ++i) now_.velocities[i] -= time * gradient_[i];
  }

  void evaluate_afresh() {
    ode_ = make_ode_();
    evaluate();
  }

  void evaluate() {
    const TissueState& state = now_.state;
    if (ode_->gradient(state.time, state.view(), {state.layout(), gradient_}) != Evaluation::ok)
      throw NumericalError(
          fmt::format("constant-energy motion at time {:.6g}, step {:.3g}: {}", state.time, step_, ode_->refusal()));
  }

  double energy() const {
    double sum = kinetic_energy(now_.velocities);
    for (const auto& term : energies_) sum += term->energy(now_.state.time, now_.state.view());
    return sum;
  }

  const MakeOde& make_ode_;
  const TermList& energies_;
  const StepWatch<ConstantEnergyState>& watch_;
  double checkpoint_interval_;
  long steps_;
  double step_;
  ConstantEnergyState now_;
  std::vector<double> gradient_;
  std::unique_ptr<TissueOde> ode_;
};

}  // namespace

EnergyReport move_at_constant_energy(const MakeOde& make_ode, const TermList& energies, TissueState& state,
                                     std::vector<double>& velocities, double duration, double time_step,
                                     double checkpoint_interval, const StepWatch<ConstantEnergyState>& watch) {
  SUTURE_EXPECTS(velocities.size() == static_cast<std::size_t>(state.layout().positions()));
  ConstantEnergyState initial{.state = state, .velocities = velocities, .start = state.time};
  if (watch.resumed) initial = *watch.resumed;
  ConstantEnergyState moved =
      ConstantEnergyMotion(make_ode, energies, std::move(initial), duration, time_step, checkpoint_interval, watch).run();
  state = std::move(moved.state);
  velocities = std::move(moved.velocities);
  return moved.report;
}

namespace {

class Relaxation {
 public:
  Relaxation(const Config& config, const TissueState& state, double duration, const MotionProgress& progress,
             const StepWatch<RelaxationState>& watch)
      : config_(config),
        progress_(progress),
        watch_(watch),
        now_(watch.resumed ? *watch.resumed : RelaxationState{.state = state, .start = state.time}),
        duration_(duration),
        end_(now_.start + duration) {
    // Whatever integrator the closure is to be studied with, it starts from the same wound.
    Config relaxation = config;
    relaxation.integrator = {.method = Method::cvode, .tolerance = config.anneal.tolerance};
    integrator_options_ = integrator_options(relaxation, make_tissue(config).mean_initial_rest_length());
    start_integrator();
  }

  RelaxationState run() {
    double next = next_multiple(now_.start, config_.checkpoint.interval, integrator_->time());
    while (integrator_->time() < end_) {
      const double t = integrator_->step(end_);
      report(t);
      if (t >= end_) break;
      if (t >= next) {
        save(SavePoint::configured);
        next = next_multiple(now_.start, config_.checkpoint.interval, t);
      } else if (watch_.is_due()) {
        save(SavePoint::between);
      }
    }
    take_state();
    now_.statistics += integrator_->statistics();
    now_.state.time = end_;
    return std::move(now_);
  }

 private:
  void start_integrator() {
    integrator_.reset();
    ode_ = std::make_unique<TissueOde>(now_.state.tissue, 0, elastic_options(config_, config_.contact.adhesion),
                                       std::vector<std::shared_ptr<const EnergyTerm>>{});
    integrator_options_.initial_step = now_.initial_step;
    integrator_ = make_integrator(*ode_, integrator_options_, now_.state.time, now_.state.values);
  }

  void take_state() {
    const auto reached = integrator_->state();
    now_.state.values.assign(reached.begin(), reached.end());
    now_.state.time = integrator_->time();
  }

  void save(SavePoint point) {
    const Statistics before = now_.statistics;
    take_state();
    now_.statistics += integrator_->statistics();
    ++now_.statistics.restarts;
    now_.initial_step = restart_step * integrator_->last_step();
    if (point == SavePoint::configured) start_integrator();
    watch_.offer(point, [this] { return now_; });
    if (point != SavePoint::configured) now_.statistics = before;
  }

  void report(double t) {
    constexpr int reports = 20;
    const int part = static_cast<int>(reports * (t - now_.start) / duration_ + 1e-9);
    if (part > reported_ && progress_)
      progress_(static_cast<double>(part) / reports, fmt::format("overdamped motion, {:.4g} of {:g}", t - now_.start, duration_));
    reported_ = part;
  }

  static constexpr double restart_step = 0.1;  // of the last step: order 1 needs shorter ones

  const Config& config_;
  const MotionProgress& progress_;
  const StepWatch<RelaxationState>& watch_;
  RelaxationState now_;
  double duration_, end_;
  IntegratorOptions integrator_options_;
  std::unique_ptr<TissueOde> ode_;
  std::unique_ptr<Integrator> integrator_;
  int reported_ = 0;
};

}  // namespace

Statistics relax_overdamped(const Config& config, TissueState& state, double duration, const MotionProgress& progress,
                            const StepWatch<RelaxationState>& watch) {
  if (!(duration > 0.0)) return {};
  RelaxationState relaxed = Relaxation(config, state, duration, progress, watch).run();
  state = std::move(relaxed.state);
  return relaxed.statistics;
}

}  // namespace suture
