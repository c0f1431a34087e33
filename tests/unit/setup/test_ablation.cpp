#include <algorithm>
#include <catch2/catch.hpp>

#include "support/setup_tissues.hpp"
#include "suture/errors.hpp"
#include "suture/setup/ablation.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Triangular cells of unit size whose centres lie at the given x.
TissueState row_of_cells(const std::vector<double>& centres) {
  const int cells = static_cast<int>(centres.size());
  TissueState state;
  state.tissue =
      Tissue(std::vector<int>(cells, 3), std::vector<CellMaterial>(cells), std::vector<double>(3 * cells, 1.0));
  const double x[] = {0.5, -0.25, -0.25}, y[] = {0.0, 0.4, -0.4};
  state.values.resize(9 * cells);
  for (int v = 0; v < 3 * cells; ++v) {
    state.mutable_view().x[v] = centres[v / 3] + x[v % 3];
    state.mutable_view().y[v] = y[v % 3];
    state.mutable_view().rest_length[v] = 1.0 + 0.01 * v;
  }
  return state;
}

}  // namespace

TEST_CASE("The central cells are those nearest the centre, nearest first", "[unit]") {
  const TissueState state = row_of_cells({-4.0, 5.0, 0.5, -2.0, 2.0, -1.5});  // centre 0
  CHECK(central_cells(state, 1) == std::vector{2});
  CHECK(central_cells(state, 3) == std::vector{2, 5, 3});
  CHECK(central_cells(state, 6) == std::vector{2, 5, 3, 4, 0, 1});
  CHECK(central_cells(state, 0).empty());
  CHECK_THROWS_AS(central_cells(state, 7), InputError);
}

TEST_CASE("Removing cells keeps everything of the others", "[unit]") {
  TissueState state = row_of_cells({-3.0, -1.0, 1.0, 3.0});
  state.time = 4.5;
  std::vector<double> reference;
  for (int v = 0; v < 12; ++v) reference.push_back(2.0 + v);
  state.reference_rest_length = reference;
  const TissueState wounded = remove_cells(state, {2, 0});
  REQUIRE(wounded.tissue.cell_count() == 2);
  CHECK(wounded.time == 4.5);
  const int survivors[] = {3, 4, 5, 9, 10, 11};
  for (int v = 0; v < 6; ++v) {
    CHECK(wounded.view().x[v] == state.view().x[survivors[v]]);
    CHECK(wounded.view().y[v] == state.view().y[survivors[v]]);
    CHECK(wounded.view().rest_length[v] == state.view().rest_length[survivors[v]]);
    CHECK(wounded.reference_rest_length[v] == state.reference_rest_length[survivors[v]]);
  }
}

TEST_CASE("Impossible ablations are refused in words", "[unit]") {
  TissueState state = row_of_cells({-1.0, 1.0});
  CHECK_THROWS_AS(remove_cells(state, {0, 1}), InputError);
  CHECK_THROWS_WITH(remove_cells(state, {2}), Catch::Contains("cell 2"));
  CHECK_THROWS_AS(remove_cells(state, {-1}), InputError);
  CHECK_THROWS_WITH(remove_cells(state, {1, 1}), Catch::Contains("twice"));
  state.purse_string.vertex = {0};
  CHECK_THROWS_AS(remove_cells(state, {0}), InputError);
}

TEST_CASE("Ablation relaxes the wound and fixes the reference of shape memory", "[unit]") {
  const Config config = small_config();
  const TissueState& packed = packed_small_tissue().state;
  const Ablated ablated = ablate(config, packed);
  CHECK(ablated.removed == central_cells(packed, 1));
  CHECK(ablated.state.tissue.cell_count() == 6);
  CHECK(ablated.state.time == Approx(packed.time + config.wound.relaxation_time));
  CHECK(ablated.statistics.steps > 0);
  CHECK(std::ranges::equal(ablated.state.reference_rest_length, ablated.state.view().rest_length));
  CHECK(ablated.state.values != remove_cells(packed, ablated.removed).values);
}
