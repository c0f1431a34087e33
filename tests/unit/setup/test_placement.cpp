#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "suture/setup/placement.hpp"

using namespace suture;

TEST_CASE("Discs are spread until they hardly overlap", "[unit]") {
  std::vector<double> radii(30, 0.5);
  radii.resize(50, 0.7);
  double area = 0.0;
  for (const double radius : radii) area += radius * radius;
  RandomStream random(3, RandomPurpose::centres);
  const double wall = std::sqrt(area / 0.7);
  const DiscPlacement placement = spread_discs(radii, wall, random);
  CHECK(placement.deepest_overlap < 0.05);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    CHECK(std::hypot(placement.x[i], placement.y[i]) + radii[i] < wall + 0.05);
    for (std::size_t j = 0; j < i; ++j)
      REQUIRE(std::hypot(placement.x[i] - placement.x[j], placement.y[i] - placement.y[j]) >
              radii[i] + radii[j] - 0.05);
  }
}

TEST_CASE("An impossible placement reports how deep the discs overlap", "[unit]") {
  const std::vector<double> radii(20, 1.0);
  RandomStream random(3, RandomPurpose::centres);
  CHECK(spread_discs(radii, 3.0, random).deepest_overlap > 0.5);
}

TEST_CASE("Polygons are regular, counter-clockwise and where they should be", "[unit]") {
  const Tissue tissue({5, 8}, std::vector<CellMaterial>(2), std::vector<double>(13, 0.5));
  const DiscPlacement centres{.x = {-1.0, 2.0}, .y = {0.5, -3.0}};
  const std::vector<double> radius{0.6, 0.9};
  RandomStream random(1, RandomPurpose::shapes);
  const std::vector<double> q = regular_polygons(tissue, centres, radius, 0.0, random);
  REQUIRE(q.size() == 26);
  for (int cell = 0; cell < 2; ++cell) {
    double area = 0.0;
    for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) {
      const int w = tissue.next(v);
      CHECK(std::hypot(q[v] - centres.x[cell], q[13 + v] - centres.y[cell]) == Approx(radius[cell]));
      area += 0.5 * (q[v] * q[13 + w] - q[w] * q[13 + v]);
    }
    const double corners = tissue.vertex_count(cell);
    CHECK(area == Approx(0.5 * corners * radius[cell] * radius[cell] * std::sin(2.0 * std::numbers::pi / corners)));
  }
}
