#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "simulate/bracket.hpp"

using namespace suture;

namespace {

struct Found {
  double root;
  int evaluations;
};

Found find(const std::function<double(double)>& f, double low, double high, double resolution) {
  int evaluations = 0;
  const double root = first_not_negative(low, f(low), high, f(high), resolution, [&](double t) {
    ++evaluations;
    return f(t);
  });
  CHECK(f(root) >= 0.0);
  CHECK(f(std::max(low, root - 1.0001 * resolution)) < 0.0);
  return {root, evaluations};
}

}  // namespace

TEST_CASE("a root is found from the side where the function is not negative", "[unit]") {
  CHECK(find([](double t) { return t - 0.3; }, 0.0, 1.0, 1e-9).root == Approx(0.3).margin(2e-9));
  CHECK(find([](double t) { return t * t * t - 0.2; }, 0.0, 1.0, 1e-9).root == Approx(std::cbrt(0.2)).margin(2e-9));
  CHECK(find([](double t) { return std::exp(20.0 * t) - 1e4; }, 0.0, 1.0, 1e-9).root == Approx(std::log(1e4) / 20.0).margin(2e-9));
  CHECK(find([](double t) { return t < 0.7 ? -1e-300 : 5.0; }, 0.0, 1.0, 1e-9).root == Approx(0.7).margin(2e-9));
  CHECK(find([](double t) { return t < 0.123 ? t - 0.2 : 0.0; }, 0.0, 1.0, 1e-9).root == Approx(0.123).margin(2e-9));
  CHECK(find([](double t) { return t - 1e-12; }, 0.0, 1.0, 1e-6).root <= 1e-6);
  CHECK(find([](double t) { return t - 1.0; }, 0.0, 1.0, 1e-6).root == Approx(1.0).margin(1e-6));
}

TEST_CASE("few evaluations find the root of a smooth function, bisection's the place of a jump", "[unit]") {
  const double resolution = 1e-6;
  CHECK(find([](double t) { return t - 0.3; }, 0.0, 1.0, resolution).evaluations <= 5);
  CHECK(find([](double t) { return std::sin(t) - 0.5; }, 0.0, 1.0, resolution).evaluations <= 9);
  CHECK(find([](double t) { return t < 0.7 ? -0.01 : 5.0; }, 0.0, 1.0, resolution).evaluations <= 45);
}
