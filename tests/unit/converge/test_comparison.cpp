// The errors of a course against a reference, on courses made by hand.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "suture/converge/study.hpp"
#include "suture/errors.hpp"

using namespace suture;

namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

/// Two vertices at (0, 0) and (1, 0), sampled at t = 0, 1, 2, ...; the second is displaced in y by offsets[k].
Course course(const std::vector<double>& offsets) {
  Course made;
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    made.time.push_back(static_cast<double>(k));
    made.positions.push_back({0.0, 1.0, 0.0, offsets[k]});
    made.area.push_back(2.0 + 0.1 * offsets[k]);
    made.shape.emplace_back(1.5 - offsets[k]);
  }
  return made;
}

}  // namespace

TEST_CASE("errors are the largest over time, in the unit given", "[unit]") {
  Course exact = course({0.0, 0.0, 0.0}), off = course({0.0, 0.4, -0.2});
  exact.t_05 = 7.0, off.t_05 = 6.5;
  const CourseErrors errors = compare(off, exact, 0.5, forever, 10.0);
  CHECK(errors.position == Approx(0.4 / 2.0 / 0.5));  // four coordinates, one of them wrong
  CHECK(errors.position_max == Approx(0.4 / 0.5));
  CHECK(errors.area == Approx(0.04));
  CHECK(*errors.shape == Approx(0.4));
  CHECK(*errors.t_05 == Approx(0.5));
  CHECK(errors.until == 2.0);
  CHECK_FALSE(errors.diverged_at);
}

TEST_CASE("after the divergence nothing is compared, but its time is found", "[unit]") {
  const Course exact = course({0.0, 0.0, 0.0, 0.0}), off = course({0.0, 0.01, 3.0, 5.0});
  const CourseErrors all = compare(off, exact, 1.0, forever, 0.1);
  REQUIRE(all.diverged_at);
  CHECK(*all.diverged_at == 2.0);
  CHECK(all.position_max == Approx(5.0));
  const CourseErrors before = compare(off, exact, 1.0, 1.5, 0.1);
  CHECK(before.position_max == Approx(0.01));
  CHECK(before.until == 1.0);
  CHECK(*before.diverged_at == 2.0);
}

TEST_CASE("a course that ends early is compared as far as it goes", "[unit]") {
  const Course exact = course({0.0, 0.0, 0.0}), early = course({0.0, 0.3});
  CHECK(compare(early, exact, 1.0, forever, 10.0).until == 1.0);
  Course late = exact;
  for (double& t : late.time) t += 0.5;
  CHECK_THROWS_AS(compare(late, exact, 1.0, forever, 10.0), InputError);
}

TEST_CASE("the table has the contract's columns first and as many fields in every line", "[unit]") {
  StudyResult result;
  StudyRow good, failed;
  good.method = Method::rkc2, good.tolerance_or_dt = 1e-3, good.errors.position = 2e-4, good.seeds = 1;
  failed.method = Method::euler, failed.tolerance_or_dt = 0.1, failed.seeds = 0, failed.failure = "blew up, badly";
  result.rows = {good, failed};
  const std::string text = study_csv(result);
  CHECK(text.starts_with("method,tolerance_or_dt,error_position,error_area,error_shape,error_t5,rate_evaluations,steps,wall_s,"));
  std::vector<long> commas(1, 0);
  for (const char c : text) {
    if (c == ',') ++commas.back();
    if (c == '\n') commas.push_back(0);
  }
  REQUIRE(commas.size() == 4);
  CHECK(commas[1] == commas[0]);
  CHECK(commas[2] == commas[0]);
  CHECK(text.find("\nrkc2,0.001,0.0002,") != std::string::npos);
  CHECK(text.find("\neuler,0.1,,") != std::string::npos);  // no errors without a run
}

TEST_CASE("a study of contradictory options is refused in words", "[unit]") {
  StudyRequest request;
  request.config.run.protocol = Protocol::dipole;
  request.options = {.methods = {Method::cvode}, .tolerances = {1e-3}, .steps = {}, .seeds = {1}, .reference_tolerance = 1e-5};
  request.options.confirmation = Method::cvode;
  CHECK_THROWS_WITH(run_study(request), Catch::Matchers::Contains("second method"));
  request.options.confirmation = Method::euler;
  CHECK_THROWS_WITH(run_study(request), Catch::Matchers::Contains("adaptive"));
  request.options.confirmation = Method::rkc2;
  request.options.methods = {Method::euler};
  CHECK_THROWS_WITH(run_study(request), Catch::Matchers::Contains("--steps"));
  request.options.methods = {Method::rkc2};
  request.options.tolerances = {};
  CHECK_THROWS_WITH(run_study(request), Catch::Matchers::Contains("--tolerances"));
}
