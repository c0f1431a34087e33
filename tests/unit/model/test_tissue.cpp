#include <catch2/catch.hpp>

#include <cmath>
#include <utility>

#include "suture/errors.hpp"
#include "suture/model/state.hpp"
#include "suture/model/tissue.hpp"

using namespace suture;

TEST_CASE("a tissue knows its cells, vertices and neighbours along the membrane", "[unit]") {
  const Tissue tissue({3, 5}, {CellMaterial{}, CellMaterial{}}, std::vector<double>(8, 0.5));
  CHECK(tissue.cell_count() == 2);
  CHECK(tissue.vertex_count() == 8);
  CHECK(tissue.next(2) == 0);
  CHECK(tissue.previous(0) == 2);
  CHECK(tissue.next(7) == 3);
  CHECK(tissue.previous(3) == 7);
  CHECK(tissue.cell_of(3) == 1);
  CHECK(tissue.vertex_name(4) == "cell 1, vertex 1");
  CHECK(tissue.subset({1}).vertex_count() == 5);
}

TEST_CASE("a tissue refuses impossible cells", "[unit]") {
  CHECK_THROWS_AS(Tissue({2}, {CellMaterial{}}, {0.5, 0.5}), InputError);
  CHECK_THROWS_AS(Tissue({3}, {}, {0.5, 0.5, 0.5}), InputError);
  CHECK_THROWS_AS(Tissue({3}, {CellMaterial{}}, {0.5, 0.5}), InputError);
  CHECK_THROWS_AS(Tissue({3}, {CellMaterial{}}, {0.5, 0.0, 0.5}), InputError);
}

TEST_CASE("copies of a tissue share their arrays, and one that was moved from stays whole", "[unit]") {
  Tissue tissue({3, 5}, {CellMaterial{}, CellMaterial{}}, std::vector<double>(8, 0.5));
  const double* const lengths = tissue.initial_rest_lengths().data();
  const Tissue copy = tissue, moved = std::move(tissue);
  CHECK(copy.initial_rest_lengths().data() == lengths);
  CHECK(moved.initial_rest_lengths().data() == lengths);
  CHECK(tissue.vertex_count() == 8);
  const Tissue stiff = copy.with_materials({CellMaterial{}, CellMaterial{.area_stiffness = 40.0}});
  CHECK(stiff.initial_rest_lengths().data() == lengths);
  CHECK(stiff.material(1).area_stiffness == 40.0);
  CHECK(copy.material(1).area_stiffness == 16.0);
  tissue = stiff.subset({1});  // its own arrays, whoever held the others
  CHECK(tissue.material(0).area_stiffness == 40.0);
  CHECK(tissue.initial_rest_length(4) == 0.5);
  CHECK(Tissue().subset({}).cell_count() == 0);
  CHECK(Tissue().first_vertex(0) == 0);
}

TEST_CASE("states share what none of them changes", "[unit]") {
  TissueState state;
  state.tissue = Tissue({3}, {CellMaterial{}}, {0.5, 0.6, 0.7});
  state.reference_rest_length = std::vector{1.0, 2.0, 3.0};
  const TissueState copy = state;
  CHECK(copy.reference_rest_length.data() == state.reference_rest_length.data());
  CHECK(copy.reference_rest_length == SharedValues(std::vector{1.0, 2.0, 3.0}));
  state.reference_rest_length = std::vector{1.0, 2.0, 4.0};
  CHECK(copy.reference_rest_length[2] == 3.0);
  CHECK_FALSE(copy.reference_rest_length == state.reference_rest_length);
  CHECK_FALSE(copy.reference_rest_length == SharedValues());
  CHECK(SharedValues(std::vector<double>()) == SharedValues());
  CHECK(SharedValues().to_vector().empty());
}

TEST_CASE("the default rest length is the published one", "[unit]") {
  // data/reference_forces: s = l0 = 0.12967913341208 for A = 1.2, n_v = 30, a0 = 1.
  CHECK(regular_rest_length(30, 1.0, 1.2) == Approx(0.12967913341208).epsilon(1e-13));
}

TEST_CASE("cell types override the defaults and share the cell count", "[unit]") {
  Config config;
  config.tissue.cells = 10;
  config.cell_types.push_back({.name = "stiff", .cells = 4, .vertices = 20, .area_stiffness = 40.0});
  const Tissue tissue = make_tissue(config);
  CHECK(tissue.cell_count() == 10);
  CHECK(tissue.vertex_count(0) == 20);
  CHECK(tissue.vertex_count(9) == 30);
  CHECK(tissue.material(3).area_stiffness == 40.0);
  CHECK(tissue.material(4).area_stiffness == 16.0);
  config.cell_types[0].cells = 11;
  CHECK_THROWS_AS(make_tissue(config), InputError);
}
