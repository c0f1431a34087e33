#include <algorithm>
#include <catch2/catch.hpp>

#include "suture/render/colour_map.hpp"

using namespace suture;

TEST_CASE("the colour map rises in luminance from dark to light, without a step", "[unit]") {
  constexpr int steps = 256;
  double smallest = 1.0, largest = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double rise = luminance(colour_at((i + 1.0) / steps)) - luminance(colour_at(static_cast<double>(i) / steps));
    smallest = std::min(smallest, rise);
    largest = std::max(largest, rise);
  }
  CHECK(smallest > 0.0);
  CHECK(largest < 4.0 / steps);
  CHECK(luminance(colour_at(0.0)) < 0.08);
  CHECK(luminance(colour_at(1.0)) > 0.7);
}

TEST_CASE("colours stay inside sRGB and the map is clamped at its ends", "[unit]") {
  for (int i = -5; i <= 105; ++i) {
    const Colour colour = colour_at(0.01 * i);
    for (const double component : {colour.red, colour.green, colour.blue}) {
      CHECK(component >= 0.0);
      CHECK(component <= 1.0);
    }
  }
  CHECK(colour_at(-3.0).blue == colour_at(0.0).blue);
  CHECK(colour_at(7.0).red == colour_at(1.0).red);
}

TEST_CASE("luminance weighs the primaries as sRGB does", "[unit]") {
  CHECK(luminance({1.0, 1.0, 1.0}) == Approx(1.0));
  CHECK(luminance({0.0, 1.0, 0.0}) == Approx(0.7152));
  CHECK(luminance({0.0, 0.0, 0.0}) == 0.0);
  CHECK(mix({0.0, 0.0, 0.0}, {1.0, 0.5, 0.0}, 0.5).green == 0.25);
}
