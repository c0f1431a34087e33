// Integrations compared at sample times: an adaptive reference that a second method confirms, and the time up to which the two
// agree. Contacts that switch the other way make trajectories diverge, and no error can be measured from then on.
#pragma once

#include "problems.hpp"

namespace suture::benchmark {

/// From state.time = 0 on.
struct Problem {
  Config config;
  TissueState state;
  bool closure = false;  ///< with all events, from a wound without a ring; otherwise a smooth problem, ring on, no events
};

struct Samples {
  std::vector<std::vector<double>> positions;  ///< at every multiple of the interval: x, then y of the cell vertices
  Statistics statistics;
};
Samples sample(const Problem& problem, Method method, double tolerance_or_step, double interval, int count);

struct SampledReference {
  std::vector<std::vector<double>> positions;  ///< as long as both methods agree; perhaps none
  double interval = 0.0;
  double uncertainty = 0.0;  ///< their largest difference, rms in l0
  int count() const { return static_cast<int>(positions.size()); }
  double agreed_until() const { return interval * count(); }
};
/// rkc2 confirmed by cvode, both at `tolerance`; `count` samples, and no more from the first on that differs by more than `agreement`.
SampledReference sampled_reference(const Problem& problem, double end, int count, double tolerance, double agreement);

/// Largest rms error over the samples of the reference, in l0; infinite where the run has fewer.
double sampled_error(const Problem& problem, const Samples& samples, const SampledReference& reference);

}  // namespace suture::benchmark
