#include "suture/simulate/cell_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "suture/errors.hpp"
#include "suture/geometry/polygon.hpp"
#include "suture/measure/cell_shape.hpp"
#include "suture/measure/membrane.hpp"
#include "suture/ode/tissue_ode.hpp"
#include "suture/physics/constant_load.hpp"
#include "suture/physics/term_sum.hpp"

namespace suture {

namespace {

constexpr double same_time = 1e-9;  // of an interval: times closer than this are one

TissueOdeOptions ode_options(const Config& config, const Tissue& tissue) {
  TissueOdeOptions options;
  options.membrane_law = config.membrane.law;
  options.contact = config.contact;
  options.contact.distance = make_membrane(config.contact, tissue).contact_distance;
  options.skin = config.integrator.skin * tissue.mean_initial_rest_length();
  options.threads = config.integrator.threads;
  return options;
}

/// Multiples of an interval, one after the other.
class Schedule {
 public:
  explicit Schedule(double interval) : interval_(interval) {}
  double next() const { return static_cast<double>(count_) * interval_; }
  bool due(double time) const { return next() <= time + same_time * interval_; }
  void pass(double time) {
    while (due(time)) ++count_;
  }

 private:
  double interval_;
  long count_ = 0;
};

class CellExperiment {
 public:
  CellExperiment(const Config& config, const Progress& progress)
      : config_(config),
        progress_(progress),
        state_(make_round_cell(config)),
        phases_(load_phases(config, state_)),
        energies_(make_cell_terms(state_.tissue, config)),
        ode_(state_.tissue, 0, ode_options(config, state_.tissue), {}),
        samples_(config.output.interval),
        frames_(config.output.frame_interval) {
    if (config.run.protocol == Protocol::dipole)
      dipole_ = std::make_shared<ConstantLoad>(dipole_forces(config, state_),
                                               std::vector<double>(state_.tissue.vertex_count()));
  }

  CellExperimentResult run() {
    const auto begin = std::chrono::steady_clock::now();
    record(state_, true);
    try {
      for (const LoadPhase& phase : phases_) run_phase(phase);
    } catch (const NumericalError& error) {
      result_.failure = error.what();
      count_work();
      if (state_.time > result_.samples.back().time) record(state_, true);
    }
    result_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(result_);
  }

 private:
  void run_phase(const LoadPhase& phase);
  void take_outputs(double phase_end);
  void record(const TissueState& state, bool frame);
  void count_work();
  std::vector<std::shared_ptr<const EnergyTerm>> load(const LoadPhase& phase) const;

  const Config& config_;
  const Progress& progress_;
  TissueState state_;
  std::vector<LoadPhase> phases_;
  TermList energies_;
  TissueOde ode_;
  std::shared_ptr<const EnergyTerm> dipole_;
  Schedule samples_, frames_;
  std::unique_ptr<Integrator> integrator_;
  int integrators_ = 0;  // finished
  CellExperimentResult result_;
};

std::vector<std::shared_ptr<const EnergyTerm>> CellExperiment::load(const LoadPhase& phase) const {
  if (phase.plates) return {std::make_shared<Plates>(*phase.plates, state_.tissue.vertex_count())};
  if (dipole_) return {dipole_};
  return {};
}

void CellExperiment::record(const TissueState& state, bool frame) {
  const CellShape shape = cell_shapes(state.tissue, state.view()).front();
  const StateView view = state.view();
  CellSample sample{.time = state.time,
                    .shape_parameter = shape.shape_parameter(),
                    .area = shape.area,
                    .perimeter = shape.perimeter,
                    .shortest_segment = INFINITY};
  for (const auto& term : energies_) sample.energy += term->energy(state.time, view);
  for (int v = 0; v < state.tissue.vertex_count(); ++v) {
    const int next = state.tissue.next(v);
    const double length = std::hypot(view.x[next] - view.x[v], view.y[next] - view.y[v]);
    sample.shortest_segment = std::min(sample.shortest_segment, length / state.tissue.initial_rest_length(v));
  }
  result_.samples.push_back(sample);
  if (frame) result_.frames.push_back(state);
  samples_.pass(state.time);
  frames_.pass(state.time);
}

// Everything due before the integrator's time, from its interpolant; the end of a phase is recorded by run_phase.
void CellExperiment::take_outputs(double phase_end) {
  for (;;) {
    const double time = std::min(samples_.next(), frames_.next());
    const double margin = same_time * config_.output.interval;
    if (time > integrator_->time() || time >= phase_end - margin) return;
    TissueState state = state_;
    state.time = time;
    integrator_->interpolate(time, state.values);
    record(state, frames_.due(time));
  }
}

void CellExperiment::run_phase(const LoadPhase& phase) {
  ode_.replace_extra(0, load(phase));
  const IntegratorOptions options = integrator_options(config_, state_.tissue.mean_initial_rest_length());
  integrator_ = make_integrator(ode_, options, state_.time, state_.values);
  while (integrator_->time() < phase.end) {
    integrator_->step(phase.end);
    state_.time = integrator_->time();
    state_.values.assign(integrator_->state().begin(), integrator_->state().end());
    take_outputs(phase.end);
    report_progress(
        progress_, "experiment", state_.time / phases_.back().end,
        fmt::format("t = {:.4g}, shape parameter {:.4f}", state_.time, result_.samples.back().shape_parameter));
  }
  count_work();
  const bool last = &phase == &phases_.back(), release = phase.plates && phase.end == config_.compression.duration;
  record(state_, last || release || frames_.due(state_.time));
  if (!release) return;
  result_.release_sample = result_.samples.size() - 1;
  result_.release_frame = result_.frames.size() - 1;
}

void CellExperiment::count_work() {
  result_.statistics += integrator_->statistics();
  result_.statistics.restarts = integrators_++;
}

}  // namespace

CellExperimentResult run_cell_experiment(const Config& config, const Progress& progress) {
  return CellExperiment(config, progress).run();
}

}  // namespace suture
