// Random numbers that are the same bits on every platform, compiler and standard library.
//
// Counter-based: block i of a stream is a keyed hash of i (Philox-4x32-10: Salmon, Moraes, Dror & Shaw, SC 2011), so
// streams of different seeds, purposes or attempts never overlap and a stream can be made anywhere at no cost.
#pragma once

#include <array>
#include <cstdint>

namespace suture {

/// One stream per use of random numbers: what is drawn for one never shifts what another draws.
enum class RandomPurpose : std::uint32_t { centres = 1, shapes = 2, velocities = 3 };

/// Philox-4x32-10: four 32-bit words from a 128-bit counter and a 64-bit key.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

class RandomStream {
 public:
  /// attempt: a further independent stream of the same seed and purpose.
  RandomStream(std::uint64_t seed, RandomPurpose purpose, std::uint32_t attempt = 0);

  std::uint64_t next();  ///< uniform on all 64-bit words
  double uniform();      ///< uniform in [0, 1), a multiple of 2^-53
  double uniform(double low, double high);
  /// Standard normal, by von Neumann rejection with comparisons only (Karney 2016, algorithm N): no logarithm or
  /// cosine, whose last bits differ between mathematics libraries.
  double normal();

 private:
  bool with_probability_exp_minus(double p);  ///< true with probability exp(-p), 0 <= p <= 1

  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;  ///< words of block_ handed out
};

}  // namespace suture
