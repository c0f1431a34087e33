#include "neighbors/contact_schedule.hpp"

#include <tuple>

namespace suture {

void ContactSchedule::divide(int cells, int cells_per_block) {
  // Enough parts for many threads, but large ones: what reaches into another part is worked on far from what made it.
  constexpr int blocks_per_part = 8, fewest_parts = 8, most_parts = 64;  // a round's parts are the bits of one word
  const auto n = static_cast<std::size_t>(std::max(cells, 1));
  blocks_ = {n, cells_per_block > 0 ? static_cast<std::size_t>(cells_per_block) : n};
  const auto blocks = static_cast<std::size_t>(blocks_.count());
  const std::size_t parts = std::clamp<std::size_t>(blocks / blocks_per_part, fewest_parts, most_parts);
  parts_ = {blocks, (blocks + parts - 1) / parts};
}

/// Every pair goes into the first round in which neither of its parts is taken.
void ContactSchedule::number_rounds() {
  taken_.clear();
  for (Pair& pair : pairs_) {
    const std::uint64_t both = std::uint64_t{1} << pair.first | std::uint64_t{1} << pair.second;
    auto round = std::find_if(taken_.begin(), taken_.end(), [&](std::uint64_t taken) { return (taken & both) == 0; });
    pair.round = static_cast<int>(round - taken_.begin());
    if (round == taken_.end())
      taken_.push_back(both);
    else
      *round |= both;
  }
  const auto place = [](const Pair& pair) { return std::tuple(pair.round, pair.first, pair.second); };
  std::sort(pairs_.begin(), pairs_.end(), [&](const Pair& a, const Pair& b) { return place(a) < place(b); });
}

}  // namespace suture
