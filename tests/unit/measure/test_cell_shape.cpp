#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "support/wound_tissues.hpp"
#include "suture/errors.hpp"
#include "suture/measure/cell_shape.hpp"

using namespace suture;
using namespace suture::test;

namespace {

Polygon square(double x, double y, double side) { return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}; }

}  // namespace

TEST_CASE("shape parameter and area strain of squares", "[unit]") {
  const TissueState state = tissue_of({square(0, 0, 1), square(5, 5, 2)});
  const auto shapes = cell_shapes(state.tissue, state.view());
  REQUIRE(shapes.size() == 2);
  CHECK(shapes[0].shape_parameter() == Approx(4.0 / std::numbers::pi));
  CHECK(shapes[1].shape_parameter() == Approx(4.0 / std::numbers::pi));
  CHECK(shapes[1].centre.x == Approx(6.0));
  CHECK(area_strains(state.tissue, state.view()) == std::vector<double>{0.0, 3.0});
}

TEST_CASE("adjacent cells by the printed and the published rule", "[unit]") {
  const TissueState state = tissue_of({square(0, 0, 1), square(0, 2, 1), square(0, 8, 1)});
  const double reach = std::sqrt(1.0 / std::numbers::pi);
  const Polygon far{{-5, 1 + 1.01 * reach}, {5, 1 + 1.01 * reach}, {5, 2 - 1e-3}, {-5, 2 - 1e-3}};
  const Polygon near{{-5, 1 + 0.99 * reach}, {5, 1 + 0.99 * reach}, {5, 2 - 1e-3}, {-5, 2 - 1e-3}};
  CHECK(adjacent_cells(state.tissue, state.view(), far) == std::vector<int>{1});
  CHECK(adjacent_cells(state.tissue, state.view(), near) == std::vector<int>{0, 1});
  CHECK(adjacent_cells(state.tissue, state.view(), far, 1.1) == std::vector<int>{0, 1});
  CHECK(adjacent_cells(state.tissue, state.view(), {}).empty());
  const Polygon around{{-9, 7}, {9, 7}, {9, 19}, {-9, 19}};
  CHECK(adjacent_cells(state.tissue, state.view(), around) == std::vector<int>{2});

  const std::vector<Point> string{{0.5, 0.5 + 1.99 * reach}};
  CHECK(adjacent_cells_published(state.tissue, state.view(), string) == std::vector<int>{0, 1});
  const std::vector<Point> higher{{0.5, 0.5 + 2.01 * reach}};
  CHECK(adjacent_cells_published(state.tissue, state.view(), higher) == std::vector<int>{1});
  CHECK(adjacent_cells_published(state.tissue, state.view(), {}).empty());
}

TEST_CASE("the healed shape falls back on the six largest", "[unit]") {
  std::vector<Polygon> cells;
  for (int i = 1; i <= 8; ++i) cells.push_back({{0, 0}, {1.0 * i, 0}, {1.0 * i, 1}, {0, 1}});
  const TissueState state = tissue_of(cells);
  const auto shapes = cell_shapes(state.tissue, state.view());
  const auto rectangle = [](double i) { return (i + 1) * (i + 1) / (std::numbers::pi * i); };
  const std::vector<int> two{0, 3};
  CHECK(healed_shape(shapes, two) == Approx(0.5 * (rectangle(1) + rectangle(4))));
  double sum = 0.0;
  for (int i = 3; i <= 8; ++i) sum += rectangle(i);
  CHECK(healed_shape(shapes, {}) == Approx(sum / 6));
  CHECK_FALSE(mean_shape_parameter(shapes, {}));
  CHECK(healed_shape(std::span(shapes).first(1), {}) == Approx(rectangle(1)));
  CHECK_THROWS_AS(healed_shape({}, {}), InputError);
}
