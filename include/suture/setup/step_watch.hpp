// How a long computation is saved between its steps, stopped there, and taken up again later.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace suture {

/// Where a computation stands when it offers its state to be saved.
enum class SavePoint {
  configured,  ///< at a time the configuration fixes; what is hidden in solvers is dropped there, so going on from the
               ///< saved state gives the same bits as going on without interruption
  natural,     ///< nothing is hidden in solvers here anyway: the same holds
  between,     ///< anywhere else: going on from the saved state agrees to tolerance
};

/// State: everything the future of the computation depends on.
template <class State>
struct StepWatch {
  std::function<bool()> due;                    ///< asked after every step: save, although it is no special point?
  std::function<void(State, SavePoint)> save;   ///< may throw to end the computation
  std::optional<State> resumed;                 ///< where to go on; empty: at the beginning

  bool is_due() const { return due && due(); }
  /// make: returns the State; called only if somebody listens.
  template <class Make>
  void offer(SavePoint point, Make&& make) const {
    if (save) save(make(), point);
  }
};

/// The first of start + interval, start + 2 interval, ... after t; infinite for an infinite interval.
inline double next_multiple(double start, double interval, double t) {
  return std::isinf(interval) ? interval : start + (std::floor((t - start) / interval + 1e-9) + 1.0) * interval;
}

}  // namespace suture
