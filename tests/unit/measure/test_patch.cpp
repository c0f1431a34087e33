#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "support/wound_tissues.hpp"
#include "suture/errors.hpp"
#include "suture/measure/patch.hpp"

using namespace suture;
using namespace suture::test;

TEST_CASE("a honeycomb is one confluent patch, with a cell missing it is not", "[unit]") {
  const Membrane m = default_membrane();
  const TissueState whole = tissue_of(honeycomb({.rings = 3}));
  const PatchReport good = inspect_patch(whole.tissue, whole.view(), m, false);
  CHECK(good.components == 1);
  CHECK(good.confluent(0.05));
  const TissueState pierced =
      tissue_of(honeycomb({.rings = 3, .removed = [](Point p) { return std::hypot(p.x, p.y) < 0.1; }}));
  const PatchReport bad = inspect_patch(pierced.tissue, pierced.view(), m, false);
  CHECK(bad.largest_hole() > 0.8);
  CHECK_FALSE(bad.confluent(0.05));
  const PatchReport wounded = inspect_patch(pierced.tissue, pierced.view(), m, true);
  CHECK(wounded.confluent(0.05));
  CHECK(*wounded.wound_area == bad.largest_hole());
}

TEST_CASE("two patches are not confluent", "[unit]") {
  auto cells = honeycomb({.rings = 1});
  for (Polygon cell : honeycomb({.rings = 1})) {
    for (Point& p : cell) p.x += 6.0;
    cells.push_back(cell);
  }
  const TissueState state = tissue_of(cells);
  const PatchReport report = inspect_patch(state.tissue, state.view(), default_membrane(), false);
  CHECK(report.components == 2);
  CHECK_FALSE(report.confluent(1.0));
}

TEST_CASE("packing fraction and extents of known cells", "[unit]") {
  const TissueState state = tissue_of({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{3, 0}, {4, 0}, {4, 1}, {3, 1}}});
  const Membrane m{.contact_distance = 0.2, .range = 0.3};
  const double each = 1.0 + 4.0 * 0.1 + std::numbers::pi * 0.01;
  CHECK(packing_fraction(state.tissue, state.view(), m, 3.0) == Approx(2.0 * each / (9.0 * std::numbers::pi)));
  CHECK_THROWS_AS(packing_fraction(state.tissue, state.view(), m, 0.0), InputError);
  const Extents extents = tissue_extents(state.tissue, state.view());
  CHECK(extents.centre.x == Approx(2.0));
  CHECK(extents.centre.y == Approx(0.5));
  CHECK(extents.radius == Approx(std::hypot(2.0, 0.5)));
  CHECK(extents.box.x_high == 4.0);
  CHECK_THROWS_AS(tissue_extents(Tissue{}, StateView{}), InputError);
}
