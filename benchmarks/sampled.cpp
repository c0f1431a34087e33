#include "sampled.hpp"

#include <algorithm>

#include "suture/ode/purse_string_events.hpp"

namespace suture::benchmark {

Samples sample(const Smooth& problem, const IntegratorOptions& options, double interval, int count) {
  const std::unique_ptr<TissueOde> ode = make_ode(problem.config, problem.state);
  const std::unique_ptr<Integrator> integrator = make_integrator(*ode, options, 0.0, problem.state.values);
  const double end = interval * count;
  Samples samples;
  while (integrator->time() < end) {
    const std::optional<double> kink = next_kink_time(problem.state.purse_string, integrator->time());
    integrator->step(std::min(end, kink.value_or(end)));
    for (double due; (due = interval * static_cast<double>(samples.y.size() + 1)) <= integrator->time() && due <= end;) {
      samples.y.emplace_back(problem.state.values.size());
      integrator->interpolate(due, samples.y.back());
    }
  }
  samples.statistics = integrator->statistics();
  return samples;
}

SampledReference sampled_reference(const Smooth& problem, double end, double tolerance, double agreement) {
  constexpr int count = 20;
  SampledReference reference;
  reference.interval = end / count;
  const auto with = [&](Method method) {
    return sample(problem, with_tolerance(method, tolerance, problem.state), reference.interval, count).y;
  };
  reference.y = with(Method::rkc2);
  const std::vector<std::vector<double>> second = with(Method::cvode);
  for (int k = 0; k < reference.count(); ++k) {
    const double difference = position_errors(problem.state, second[k], reference.y[k]).rms;
    if (difference > agreement) {
      reference.y.resize(k);
      break;
    }
    reference.uncertainty = std::max(reference.uncertainty, difference);
  }
  return reference;
}

double sampled_error(const Smooth& problem, const Samples& samples, const SampledReference& reference) {
  double error = 0.0;
  for (int k = 0; k < reference.count(); ++k)
    error = std::max(error, position_errors(problem.state, samples.y.at(k), reference.y[k]).rms);
  return error;
}

}  // namespace suture::benchmark
