// The error made follows the error asked for, for every material the project is about: nine cells in contact, adhesion on,
// relaxing from a rough start. The benchmark group "grid" does the same on a whole wound with its ring.
#include <catch2/catch.hpp>

#include "support/integration.hpp"
#include "support/random_tissue.hpp"

using namespace suture;
using namespace suture::test;

TEST_CASE("CVODE's error is within 0.01 and 10 times its tolerance for every stiffness and plastic time", "[convergence]") {
  const TissueState rough = random_tissue(5, {.rows = 3, .columns = 3, .minimum_vertices = 14, .maximum_vertices = 22, .spacing = 0.95, .roughness = 0.1, .strain = 0.05});
  const double end = 1.0, unit = rough.tissue.mean_initial_rest_length();
  int checked = 0;
  for (const double area_stiffness : {0.25, 1.0, 16.0, 40.0, 256.0})
    for (const double tau : {2.4, 9.6, 76.8, 1228.8, 39321.6}) {
      const CellMaterial material{.area_stiffness = area_stiffness, .bending_stiffness = 0.01, .tau = tau};
      const Tissue tissue = rough.tissue.with_materials(std::vector<CellMaterial>(static_cast<std::size_t>(rough.tissue.cell_count()), material));
      TissueOde ode(tissue, 0, ode_options(contact_law(unit)), {});
      const auto reference = integrate(ode, with_tolerance(Method::rkc2, 1e-7 * unit), 0.0, rough.values, end);
      const auto positions = static_cast<std::size_t>(ode.position_count());
      REQUIRE(largest_difference(reference, rough.values) > 0.1 * unit);
      for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
        Statistics statistics;
        const auto y = integrate(ode, with_tolerance(Method::cvode, tolerance * unit), 0.0, rough.values, end, &statistics);
        const double ratio = rms_difference(std::span(y).first(positions), std::span(reference).first(positions)) / (tolerance * unit);
        CAPTURE(area_stiffness, tau, tolerance, ratio, statistics.steps);
        CHECK(ratio > 0.01);
        CHECK(ratio < 10.0);
        ++checked;
      }
    }
  CHECK(checked == 75);
}
