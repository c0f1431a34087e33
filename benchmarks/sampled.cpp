#include "sampled.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "suture/converge/study.hpp"
#include "suture/ode/purse_string_events.hpp"
#include "suture/simulate/closure.hpp"

namespace suture::benchmark {

namespace {

std::vector<double> vertex_positions(const StateLayout& layout, std::span<const double> y) {
  const StateView view(layout, y);
  std::vector<double> positions(view.x.begin(), view.x.begin() + layout.vertices);
  positions.insert(positions.end(), view.y.begin(), view.y.begin() + layout.vertices);
  return positions;
}

class PositionObserver final : public ClosureObserver {
 public:
  explicit PositionObserver(Samples& samples) : samples_(samples) {}
  void sample(const ClosureSample& s) override {
    if (s.time > 0.0) samples_.positions.push_back(vertex_positions(s.state.layout(), s.state.values));
  }
  void event(const EventRecord&) override {}

 private:
  Samples& samples_;
};

Samples sample_closure(const Problem& problem, Method method, double tolerance_or_step, double interval, int count) {
  Config config = problem.config;
  config.integrator.method = method;
  if (takes_fixed_steps(method))
    config.integrator.time_step = tolerance_or_step;
  else
    config.integrator.tolerance = config.integrator.rest_length_tolerance = tolerance_or_step;
  config.output.interval = interval;
  config.run.end_time = interval * count;
  config.run.closed_area = 0.0;  // all the way
  Samples samples;
  PositionObserver observer(samples);
  TissueState last_good;
  samples.statistics = run_closure(config, problem.state, observer, last_good).statistics;
  return samples;
}

double rms_difference(const Problem& problem, const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size())) / problem.state.tissue.mean_initial_rest_length();
}

}  // namespace

Samples sample(const Problem& problem, Method method, double tolerance_or_step, double interval, int count) {
  if (problem.closure) return sample_closure(problem, method, tolerance_or_step, interval, count);
  const IntegratorOptions options = (takes_fixed_steps(method) ? with_step : with_tolerance)(method, tolerance_or_step, problem.state);
  const std::unique_ptr<TissueOde> ode = make_ode(problem.config, problem.state);
  const std::unique_ptr<Integrator> integrator = make_integrator(*ode, options, 0.0, problem.state.values);
  const double end = interval * count;
  Samples samples;
  std::vector<double> y(problem.state.values.size());
  while (integrator->time() < end) {
    const std::optional<double> kink = next_kink_time(problem.state.purse_string, integrator->time());
    integrator->step(std::min(end, kink.value_or(end)));
    for (double due; (due = interval * static_cast<double>(samples.positions.size() + 1)) <= integrator->time() && due <= end;) {
      integrator->interpolate(due, y);
      samples.positions.push_back(vertex_positions(problem.state.layout(), y));
    }
  }
  samples.statistics = integrator->statistics();
  return samples;
}

SampledReference sampled_reference(const Problem& problem, double end, int count, double tolerance, double agreement) {
  SampledReference reference;
  reference.interval = end / count;
  const auto with = [&](Method method) { return sample(problem, method, tolerance, reference.interval, count).positions; };
  reference.positions = with(Method::rkc2);
  const std::vector<std::vector<double>> second = with(Method::cvode);
  reference.positions.resize(std::min(reference.positions.size(), second.size()));
  for (int k = 0; k < reference.count(); ++k) {
    const double difference = rms_difference(problem, second[k], reference.positions[k]);
    if (difference > agreement) {
      reference.positions.resize(k);
      break;
    }
    reference.uncertainty = std::max(reference.uncertainty, difference);
  }
  return reference;
}

double sampled_error(const Problem& problem, const Samples& samples, const SampledReference& reference) {
  if (samples.positions.size() < reference.positions.size()) return std::numeric_limits<double>::infinity();
  double error = 0.0;
  for (int k = 0; k < reference.count(); ++k) error = std::max(error, rms_difference(problem, samples.positions[k], reference.positions[k]));
  return error;
}

}  // namespace suture::benchmark
