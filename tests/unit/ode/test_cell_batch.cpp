// Sixteen cells side by side in single precision, of any number of rows, against the same cells one by one.
#include <catch2/catch.hpp>
#include <cmath>

#include "ode/cell_batch.hpp"
#include "support/implicit_step.hpp"
#include "support/integration.hpp"
#include "support/random_tissue.hpp"
#include "support/runnable_tables.hpp"

using namespace suture;
using namespace suture::test;

TEST_CASE("cells that share a batch do not know of each other, whatever their sizes and number", "[unit]") {
  // Sizes around the sixteen rows that are moved at once, with all or few cells of the same size.
  const auto [least, most, columns] = GENERATE(table<int, int, int>({{3, 7, 4}, {16, 16, 4}, {17, 17, 3}, {14, 31, 4}, {30, 33, 4}, {30, 30, 4}, {47, 64, 4}}));
  CAPTURE(least, most, columns);
  const TissueState state = random_tissue(5, {.rows = 4, .columns = columns, .minimum_vertices = least, .maximum_vertices = most, .spacing = 2.0});
  const Tissue& tissue = state.tissue;
  const int cells = tissue.cell_count(), vertices = tissue.vertex_count(), points = vertices + 5;
  PaddedTissue padded(tissue, SpringLaw::quadratic);
  const kernels::Table& kernel = *GENERATE(from_range(runnable_tables()));
  CAPTURE(kernel.name);
  REQUIRE(kernel.shell_gradient(padded.shell, {state.view().x.data(), state.view().y.data(), state.view().rest_length.data()}));
  kernel.shell_linearise(padded.shell, padded.hessian);
  std::vector<double> diagonal(4 * padded.slots());
  for (int k = 0; k < padded.slots(); ++k) diagonal[4 * k] = 2.0 + std::sin(k), diagonal[4 * k + 1] = 0.1, diagonal[4 * k + 2] = 3.0;
  std::vector<double> r(2 * points), one_by_one(2 * points, 7.0), together(2 * points, 7.0);
  for (int k = 0; k < 2 * points; ++k) r[k] = std::cos(1.7 * k);
  FactorRoom room(64);
  std::vector<int> all;
  for (int cell = cells - 1; cell >= 0; --cell) {
    all.push_back(cell);
    CellBatch alone(std::span(&cell, 1), tissue);
    alone.set_up(0.05, padded, diagonal.data(), kernel, room);
    alone.apply(r.data(), one_by_one.data(), points, kernel, room);
  }
  CellBatch batch(all, tissue);
  for (const double gamma : {0.7, 0.05}) batch.set_up(gamma, padded, diagonal.data(), kernel, room);  // nothing is left of the first
  batch.apply(r.data(), together.data(), points, kernel, room);
  CHECK(largest_difference(together, one_by_one) < 1e-6 * largest(one_by_one));
  for (int k = 0; k < 5; ++k) CHECK((together[vertices + k] == 7.0 && together[points + vertices + k] == 7.0));  // not a cell's
}
