#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "suture/setup/random.hpp"

using namespace suture;

TEST_CASE("Philox gives the known answers of its authors", "[unit]") {
  // Random123, kat_vectors: philox4x32, 10 rounds.
  CHECK(philox({0, 0, 0, 0}, {0, 0}) == std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
        std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        std::array<std::uint32_t, 4>{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("A stream starts with the words of its first block", "[unit]") {
  RandomStream stream(0x0000000500000007u, RandomPurpose::shapes, 3);
  const auto block = philox({0, 0, 2, 3}, {7, 5});
  CHECK(stream.next() == (static_cast<std::uint64_t>(block[1]) << 32 | block[0]));
  CHECK(stream.next() == (static_cast<std::uint64_t>(block[3]) << 32 | block[2]));
  const auto second = philox({1, 0, 2, 3}, {7, 5});
  CHECK(stream.next() == (static_cast<std::uint64_t>(second[1]) << 32 | second[0]));
}

TEST_CASE("Seeds, purposes and attempts give different streams, equal ones the same", "[unit]") {
  std::set<std::uint64_t> first_words;
  for (const std::uint64_t seed : {1u, 2u})
    for (const RandomPurpose purpose : {RandomPurpose::centres, RandomPurpose::shapes, RandomPurpose::velocities})
      for (const std::uint32_t attempt : {0u, 1u}) first_words.insert(RandomStream(seed, purpose, attempt).next());
  CHECK(first_words.size() == 12);
  RandomStream a(9, RandomPurpose::centres), b(9, RandomPurpose::centres);
  for (int i = 0; i < 100; ++i) REQUIRE(a.normal() == b.normal());
}

TEST_CASE("Uniform numbers have the moments of the uniform distribution", "[unit]") {
  RandomStream stream(4, RandomPurpose::centres);
  constexpr int count = 200000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double u = stream.uniform(-1.0, 3.0);
    REQUIRE(u >= -1.0);
    REQUIRE(u < 3.0);
    sum += u, squares += u * u;
  }
  const double mean = sum / count, variance = squares / count - mean * mean;
  CHECK(mean == Approx(1.0).margin(5.0 * std::sqrt(16.0 / 12.0 / count)));
  CHECK(variance == Approx(16.0 / 12.0).epsilon(0.01));
}

TEST_CASE("Normal numbers have the moments and the tails of the normal distribution", "[unit]") {
  RandomStream stream(11, RandomPurpose::velocities);
  constexpr int count = 400000;
  double sum = 0.0, squares = 0.0, fourth = 0.0;
  int beyond_one = 0, beyond_two = 0, beyond_three = 0;
  for (int i = 0; i < count; ++i) {
    const double x = stream.normal();
    sum += x, squares += x * x, fourth += x * x * x * x;
    beyond_one += std::abs(x) > 1.0, beyond_two += std::abs(x) > 2.0, beyond_three += std::abs(x) > 3.0;
  }
  const auto five_sigma = [](double variance) { return 5.0 * std::sqrt(variance / count); };
  CHECK(sum / count == Approx(0.0).margin(five_sigma(1.0)));
  CHECK(squares / count == Approx(1.0).margin(five_sigma(2.0)));
  CHECK(fourth / count == Approx(3.0).margin(five_sigma(96.0)));
  for (const auto& [observed, edge] :
       {std::pair(beyond_one, 1.0), std::pair(beyond_two, 2.0), std::pair(beyond_three, 3.0)}) {
    const double expected = std::erfc(edge / std::sqrt(2.0));
    CHECK(static_cast<double>(observed) / count == Approx(expected).margin(five_sigma(expected * (1.0 - expected))));
  }
}
