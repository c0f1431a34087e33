// Ends of a colour bar.
#pragma once

#include <utility>
#include <vector>

#include "suture/replay/replay.hpp"

namespace suture {

/// The range of the finite values, widened to round numbers; of segment fields without the outermost 1 % on either side,
/// since a few collapsed segments would else leave the rest in one colour. Minimum < maximum always.
std::pair<double, double> colour_range(std::vector<double> values, Place place);

}  // namespace suture
