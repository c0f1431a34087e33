// The space-filling curve of D. Hilbert (1891): what is close on it is close in the plane.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

namespace suture {

/// Place of (x, y), both in 0 .. 1, along the curve that fills the unit square, in steps of 2^-32 of its length. Points outside
/// count as on the edge.
inline std::uint64_t hilbert_index(double x, double y) {
  constexpr std::uint32_t side = 1u << 16;
  const auto cell = [](double v) { return static_cast<std::uint32_t>(std::clamp(v * side, 0.0, side - 1.0)); };
  std::uint32_t i = cell(x), j = cell(y);
  std::uint64_t index = 0;
  for (std::uint32_t half = side / 2; half > 0; half /= 2) {
    const bool right = (i & half) != 0, upper = (j & half) != 0;
    index = 4 * index + (right ? (upper ? 2 : 3) : (upper ? 1 : 0));
    if (upper) continue;  // the lower quadrants hold the curve turned and reflected
    if (right) i = side - 1 - i, j = side - 1 - j;
    std::swap(i, j);
  }
  return index;
}

}  // namespace suture
