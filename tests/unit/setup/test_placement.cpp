#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "geometry/hilbert_curve.hpp"
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
  CHECK(placement.deepest_overlap > 0.0);
  double deepest = -wall;  // by looking at every pair
  for (std::size_t i = 0; i < radii.size(); ++i) {
    deepest = std::max(deepest, std::hypot(placement.x[i], placement.y[i]) + radii[i] - wall);
    for (std::size_t j = 0; j < i; ++j)
      deepest = std::max(deepest, radii[i] + radii[j] - std::hypot(placement.x[i] - placement.x[j], placement.y[i] - placement.y[j]));
  }
  CHECK(placement.deepest_overlap == deepest);
}

TEST_CASE("An impossible placement reports how deep the discs overlap", "[unit]") {
  const std::vector<double> radii(20, 1.0);
  RandomStream random(3, RandomPurpose::centres);
  CHECK(spread_discs(radii, 3.0, random).deepest_overlap > 0.5);
}

TEST_CASE("Along the Hilbert curve every square of a grid is entered once, from a neighbour", "[unit]") {
  constexpr int n = 64;
  std::vector<std::array<int, 2>> visited;
  std::map<std::uint64_t, std::array<int, 2>> squares;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) squares[hilbert_index((i + 0.5) / n, (j + 0.5) / n)] = {i, j};
  REQUIRE(squares.size() == n * n);
  int far = 0;
  std::array<int, 2> before = squares.begin()->second;
  for (const auto& [index, square] : squares) {
    far += std::abs(square[0] - before[0]) + std::abs(square[1] - before[1]) > 1;
    before = square;
  }
  CHECK(far == 0);
  CHECK(hilbert_index(-1.0, 2.0) == hilbert_index(0.0, 1.0));
}

TEST_CASE("Numbering along a curve keeps the places of every kind of cell and brings neighbours together", "[unit]") {
  constexpr int cells = 300;
  std::vector<CellMaterial> materials(cells);
  for (int c = 200; c < cells; ++c) materials[c].tau = 1.0;
  std::vector<int> counts(cells, 4);
  for (int c = 0; c < 100; ++c) counts[c] = 3;
  const Tissue tissue(counts, materials, std::vector<double>(100 * 3 + 200 * 4, 0.5));
  RandomStream random(5, RandomPurpose::centres);
  DiscPlacement centres;
  for (int c = 0; c < cells; ++c) centres.x.push_back(random.uniform(-4.0, 4.0)), centres.y.push_back(random.uniform(-4.0, 4.0));
  DiscPlacement numbered = centres;
  number_along_curve(tissue, numbered);
  const auto of_kind = [](const DiscPlacement& p, int kind) {
    std::multiset<std::pair<double, double>> places;
    for (int c = 100 * kind; c < 100 * kind + 100; ++c) places.emplace(p.x[c], p.y[c]);
    return places;
  };
  const auto way = [](const DiscPlacement& p, int kind) {
    double length = 0.0;
    for (int c = 100 * kind + 1; c < 100 * kind + 100; ++c) length += std::hypot(p.x[c] - p.x[c - 1], p.y[c] - p.y[c - 1]);
    return length;
  };
  for (int kind = 0; kind < 3; ++kind) {
    CHECK(of_kind(numbered, kind) == of_kind(centres, kind));
    CHECK(way(numbered, kind) < 0.3 * way(centres, kind));
  }
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
