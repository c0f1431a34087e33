#include "suture/setup/random.hpp"

namespace suture {

namespace {

struct WideProduct {
  std::uint32_t high, low;
};

WideProduct wide_product(std::uint32_t a, std::uint32_t b) {
  const std::uint64_t product = static_cast<std::uint64_t>(a) * b;
  return {static_cast<std::uint32_t>(product >> 32), static_cast<std::uint32_t>(product)};
}

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  constexpr int rounds = 10;
  constexpr std::uint32_t multiplier0 = 0xD2511F53, multiplier1 = 0xCD9E8D57;
  constexpr std::uint32_t weyl0 = 0x9E3779B9, weyl1 = 0xBB67AE85;
  for (int round = 0; round < rounds; ++round) {
    const WideProduct p0 = wide_product(multiplier0, counter[0]);
    const WideProduct p1 = wide_product(multiplier1, counter[2]);
    counter = {p1.high ^ counter[1] ^ key[0], p1.low, p0.high ^ counter[3] ^ key[1], p0.low};
    key[0] += weyl0;
    key[1] += weyl1;
  }
  return counter;
}

RandomStream::RandomStream(std::uint64_t seed, RandomPurpose purpose, std::uint32_t attempt)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{0, 0, static_cast<std::uint32_t>(purpose), attempt} {}

std::uint64_t RandomStream::next() {
  if (used_ == 4) {
    block_ = philox(counter_, key_);
    used_ = 0;
    if (++counter_[0] == 0) ++counter_[1];
  }
  const std::uint64_t word = static_cast<std::uint64_t>(block_[used_ + 1]) << 32 | block_[used_];
  used_ += 2;
  return word;
}

double RandomStream::uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

double RandomStream::uniform(double low, double high) { return low + (high - low) * uniform(); }

bool RandomStream::with_probability_exp_minus(double p) {
  // The length n of the run p > u1 > u2 > ... has P(n >= m) = p^m/m!, so it is even with probability exp(-p).
  bool even = true;
  for (double previous = p, next_one = uniform(); next_one < previous; previous = next_one, next_one = uniform())
    even = !even;
  return even;
}

double RandomStream::normal() {
  const auto all_succeed = [this](int times, double p) {
    for (int i = 0; i < times; ++i)
      if (!with_probability_exp_minus(p)) return false;
    return true;
  };
  while (true) {
    int k = 0;
    while (with_probability_exp_minus(0.5)) ++k;
    if (!all_succeed(k * (k - 1), 0.5)) continue;
    const double x = uniform();
    if (!all_succeed(k + 1, x * (2.0 * k + x) / (2.0 * k + 2.0))) continue;
    const double magnitude = k + x;
    return next() >> 63 ? -magnitude : magnitude;
  }
}

}  // namespace suture
