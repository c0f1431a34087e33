// Integrations compared at sample times: an adaptive reference that a second method confirms, and the time up to which the two
// agree. Contacts that switch the other way make trajectories diverge, and no error can be measured from then on.
#pragma once

#include "problems.hpp"

namespace suture::benchmark {

/// A smooth problem (ring on, no events) from state.time = 0 on.
struct Smooth {
  Config config;
  TissueState state;
};

struct Samples {
  std::vector<std::vector<double>> y;  ///< at every multiple of the interval
  Statistics statistics;
};
Samples sample(const Smooth& problem, const IntegratorOptions& options, double interval, int count);

struct SampledReference {
  std::vector<std::vector<double>> y;  ///< as long as both methods agree; perhaps none
  double interval = 0.0;
  double uncertainty = 0.0;  ///< their largest difference in y, rms in l0
  int count() const { return static_cast<int>(y.size()); }
  double agreed_until() const { return interval * count(); }
};
/// rkc2 confirmed by cvode, both at `tolerance`; 20 samples, and no more from the first on that differs by more than `agreement`.
SampledReference sampled_reference(const Smooth& problem, double end, double tolerance, double agreement);

/// Largest rms error over the samples of the reference.
double sampled_error(const Smooth& problem, const Samples& samples, const SampledReference& reference);

}  // namespace suture::benchmark
