#include <catch2/catch.hpp>
#include <cmath>

#include "suture/errors.hpp"
#include "suture/measure/closure.hpp"

using namespace suture;

TEST_CASE("closure times of a straight line that starts with a rise", "[unit]") {
  // Rises from 4 to 5 in one unit, then falls linearly to 0 in 10 units.
  const WoundSeries series{{0, 1, 3, 11, 20}, {4, 5, 4, 0, 0}};
  const ClosureSummary summary = summarise_closure(series);
  CHECK(summary.maximum_area == 5.0);
  CHECK(summary.time_of_maximum == 1.0);
  CHECK(*summary.t_50 == Approx(6.0));
  CHECK(*summary.t_25 == Approx(8.5));
  CHECK(*summary.t_10 == Approx(10.0));
  CHECK(*summary.t_05 == Approx(10.5));
  CHECK(*summary.closure_rate == Approx(0.95 * 5.0 / 9.5));
}

TEST_CASE("closure times of an exponential converge with the sampling", "[unit]") {
  double last_error = 1.0;
  for (const double step : {1.0, 0.5, 0.25}) {
    WoundSeries series;
    for (double t = 0.0; t <= 80.0; t += step)
      series.time.push_back(t), series.area.push_back(6.0 * std::exp(-t / 20.0));
    const double error = std::abs(*summarise_closure(series).t_05 - 20.0 * std::log(20.0));
    CHECK(error < last_error);
    CHECK(error < 0.01 * step);
    last_error = error;
  }
}

TEST_CASE("a wound that does not close has no closure times", "[unit]") {
  const ClosureSummary summary = summarise_closure({{0, 1, 2}, {5, 4, 2}});
  CHECK(summary.t_50.has_value());
  CHECK_FALSE(summary.t_25);
  CHECK_FALSE(summary.t_05);
  CHECK_FALSE(summary.closure_rate);
  CHECK_FALSE(summarise_closure({{0, 1}, {0, 0}}).t_50);
}

TEST_CASE("a dip before the maximum does not count, a rise after the first crossing does not matter", "[unit]") {
  CHECK(*time_to_fraction({{0, 1, 2, 3, 4}, {2, 0.1, 4, 0, 3}}, 0.5) == Approx(2.5));
}

TEST_CASE("the mean of several wounds pads with zero", "[unit]") {
  const std::vector<WoundSeries> seeds{{{0, 10}, {4, 0}}, {{0, 20}, {2, 2}}};
  const std::vector<double> times{0, 5, 10, 15, 25};
  const WoundSeries mean = mean_series(seeds, times);
  CHECK(mean.area == std::vector<double>{3.0, 2.0, 1.0, 1.0, 0.0});
  CHECK(mean.time == times);
}

TEST_CASE("impossible wound series are refused", "[unit]") {
  CHECK_THROWS_AS(summarise_closure({}), InputError);
  CHECK_THROWS_AS(summarise_closure({{0, 1}, {1}}), InputError);
  CHECK_THROWS_AS(summarise_closure({{0, 0}, {1, 1}}), InputError);
  CHECK_THROWS_AS(summarise_closure({{0, 1}, {1, std::nan("")}}), InputError);
  CHECK_THROWS_AS(mean_series({}, std::vector<double>{1.0}), InputError);
}
