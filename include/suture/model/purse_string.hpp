// The contractile ring on the wound edge: a closed chain of purse-string vertices, each tethered to a cell vertex
// (Ton et al. 2023, Eq. 6-7; model.md section 5). Positions live in the ODE state; this is everything else.
#pragma once

#include <algorithm>
#include <vector>

#include "suture/model/parameters.hpp"

namespace suture {

/// One spring of the chain; its rest length is an explicit function of time.
struct ChainSpring {
  double rest_length = 0.0;       ///< lambda0 at start_time
  double start_time = 0.0;
  double reference_length = 0.0;  ///< lambda0(0) of the quadratic law: stiffness k_ps/reference_length^2
};

/// A tether's discrete mode; it changes only at events, never inside the rate.
enum class TetherMode {
  attached,  ///< below l_y/2
  slipped,   ///< beyond l_y/2: no force with TetherLaw::saturating_energy, no effect with the other laws
};

/// Purse-string vertex j is tethered to cell vertex `vertex[j]`; spring[j] joins j to j+1 (cyclic), in boundary order.
struct PurseString {
  std::vector<int> vertex;
  std::vector<ChainSpring> spring;
  std::vector<TetherMode> mode;
  double shrink_rate = 0.0;          ///< omega/N_p(0), of every spring's rest length
  double minimum_rest_length = 0.0;  ///< lambda_min

  int size() const { return static_cast<int>(vertex.size()); }
  bool empty() const { return vertex.empty(); }

  /// lambda0_j(t), continuous, with a kink at kink_time(j) [Eq. 7].
  double rest_length(int j, double t) const {
    return std::max(spring[j].rest_length - shrink_rate * (t - spring[j].start_time), minimum_rest_length);
  }
  double kink_time(int j) const {
    return spring[j].start_time + (spring[j].rest_length - minimum_rest_length) / shrink_rate;
  }
};

}  // namespace suture
