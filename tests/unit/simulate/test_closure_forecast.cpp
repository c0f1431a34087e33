#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "simulate/closure_forecast.hpp"

using namespace suture;

namespace {

std::vector<WoundSample> wound(const std::vector<double>& areas) {
  std::vector<WoundSample> samples;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    WoundSample sample;
    sample.time = 0.5 * static_cast<double>(i);
    sample.wound_area = areas[i];
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace

TEST_CASE("the time until closure is forecast from how fast the wound shrinks now", "[unit]") {
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(forecast_closure({}, 0.01) == infinite);
  CHECK(forecast_closure(wound({5.0}), 0.01) == infinite);
  CHECK(forecast_closure(wound({4.0, 5.0}), 0.01) == infinite);   // it opens
  CHECK(forecast_closure(wound({5.0, 0.01}), 0.01) == 0.0);       // it is closed
  CHECK(std::isfinite(forecast_closure(wound({5.0, 4.0}), 0.0)));  // run.closed_area = 0
  // It opens, then shrinks with the time constant 8, from 5 to 0.01: that takes 8 ln 500.
  std::vector<double> areas{3.0, 4.5};
  for (int i = 0; i < 60; ++i) areas.push_back(5.0 * std::exp(-0.5 * i / 8.0));
  CHECK(forecast_closure(wound(areas), 0.01) == Approx(8.0 * std::log(500.0) - 29.5));
  // What was long ago does not count: slow at first, then with the time constant 2.
  areas = {5.0};
  for (int i = 0; i < 100; ++i) areas.push_back(5.0 - 0.001 * i);
  for (int i = 0; i < 10; ++i) areas.push_back(4.9 * std::exp(-0.5 * i / 2.0));
  CHECK(forecast_closure(wound(areas), 0.01) == Approx(2.0 * std::log(490.0) - 4.5));
}
