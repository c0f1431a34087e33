#include <catch2/catch.hpp>

#include "suture/geometry/point_segment.hpp"

using namespace suture;

TEST_CASE("the projection names the closest feature of a segment", "[unit]") {
  const Point a{1, 1}, b{3, 1};
  CHECK(project({0, 2}, a, b).feature == ClosestFeature::start);
  CHECK(project({1, 2}, a, b).feature == ClosestFeature::start);
  CHECK(project({3, 2}, a, b).feature == ClosestFeature::end);
  CHECK(project({9, 2}, a, b).feature == ClosestFeature::end);
  const Projection inside = project({1.5, -4}, a, b);
  CHECK(inside.feature == ClosestFeature::interior);
  CHECK(inside.t == 0.25);
}

TEST_CASE("the distance to a segment is measured to its closest feature", "[unit]") {
  const Point a{1, 1}, b{3, 1};
  CHECK(point_segment_distance({1.5, -4}, a, b) == 5.0);
  CHECK(point_segment_distance({-2, 5}, a, b) == 5.0);
  CHECK(point_segment_distance({6, -3}, a, b) == 5.0);
  CHECK(point_segment_distance({2, 1}, a, b) == 0.0);
}
