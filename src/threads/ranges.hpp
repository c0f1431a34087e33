// A fixed division of 0 .. n-1 into consecutive ranges: it depends on n only, never on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>

namespace suture {

/// Tissues of fewer vertices (about 1100 cells of 30) are not divided: one evaluation takes them less than half a
/// millisecond, and their results keep the bits of a program without threads.
constexpr int divided_from_vertices = 32768;

struct Range {
  std::size_t begin = 0, end = 0;
};

struct Ranges {
  std::size_t n = 0, length = 1;
  int count() const { return static_cast<int>((n + length - 1) / length); }
  Range operator[](int k) const { return {length * k, std::min(length * (k + 1), n)}; }
};

/// For vectors of n numbers: whole when they belong to a tissue that is not divided (three numbers per vertex), otherwise
/// at most `most_vector_ranges` ranges of a multiple of eight.
constexpr int most_vector_ranges = 256;
inline Ranges vector_ranges(std::size_t n) {
  constexpr std::size_t shortest = 16384, whole = 3 * static_cast<std::size_t>(divided_from_vertices);
  if (n < whole) return {n, std::max<std::size_t>(n, 1)};
  return {n, std::max(shortest, (n / most_vector_ranges + 8) / 8 * 8)};
}

}  // namespace suture
