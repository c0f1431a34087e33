// What the page needs to know about a run.
#pragma once

#include <nlohmann/json.hpp>

#include "suture/view/view_page.hpp"
#include "view/packed_numbers.hpp"

namespace suture {

struct ViewerData {
  nlohmann::json description;  ///< units, names, ranges, curves, events; small
  PackedNumbers numbers;       ///< positions and fields of all frames
};

/// frames: of the replay, ascending. Everything is in um and minutes since the time origin, as people read it.
ViewerData viewer_data(const Replay& replay, const std::vector<int>& frames);

}  // namespace suture
