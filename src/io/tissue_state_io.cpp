#include "io/tissue_state_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "suture/errors.hpp"

namespace suture {
namespace {

struct MaterialColumn {
  const char* name;
  double CellMaterial::*member;
  Hdf5Label label;
};

constexpr std::array<MaterialColumn, 6> material_columns{{
    {"rest_area", &CellMaterial::rest_area, {"area", "a0, per cell"}},
    {"area_stiffness", &CellMaterial::area_stiffness, {"energy", "k_a, per cell"}},
    {"membrane_stiffness", &CellMaterial::membrane_stiffness, {"energy", "k_l, per cell"}},
    {"bending_stiffness", &CellMaterial::bending_stiffness, {"energy", "k_b, per cell"}},
    {"tau", &CellMaterial::tau, {"time", "plastic relaxation time of the membrane, per cell; infinite if elastic"}},
    {"memory", &CellMaterial::memory, {"1", "shape-memory ratio xi, per cell"}},
}};

void expect_size(std::size_t found, std::size_t expected, const std::string& name) {
  if (found != expected) throw FileError(fmt::format("'{}' has {} entries; {} expected", name, found, expected));
}

void write_purse_string(const Hdf5Group& group, const TissueState& state) {
  const PurseString& ring = state.purse_string;
  const StateView view = state.view();
  const std::size_t first = state.tissue.vertex_count();
  const std::array<std::span<const double>, 2> position{view.x.subspan(first), view.y.subspan(first)};
  group.write_table("position", position, {"length", "purse-string vertices in boundary order: x, y"});
  group.write("vertex", ring.vertex, {"1", "cell vertex each purse-string vertex is tethered to"});
  std::vector<int> mode;
  std::vector<double> rest_length, start_time, reference_length;
  for (const TetherMode value : ring.mode) mode.push_back(static_cast<int>(value));
  for (const ChainSpring& spring : ring.spring) {
    rest_length.push_back(spring.rest_length);
    start_time.push_back(spring.start_time);
    reference_length.push_back(spring.reference_length);
  }
  group.write("mode", mode, {"1", "tether mode: 0 attached, 1 slipped"});
  group.write("spring_rest_length", rest_length,
              {"length", "lambda0 of the spring to the next vertex, at its start time"});
  group.write("spring_start_time", start_time, {"time", "since when the spring shortens"});
  group.write("spring_reference_length", reference_length, {"length", "lambda0(0), which sets the spring's stiffness"});
  group.write("shrink_rate", ring.shrink_rate, {"length/time", "of every spring's rest length"});
  group.write("minimum_rest_length", ring.minimum_rest_length, {"length", "lambda_min"});
}

PurseString read_purse_string(const Hdf5Group& group) {
  PurseString ring;
  ring.vertex = group.integers("vertex");
  const std::vector<int> mode = group.integers("mode");
  expect_size(mode.size(), ring.vertex.size(), "purse_string/mode");
  for (const int value : mode) {
    if (value != 0 && value != 1) throw FileError(fmt::format("tether mode {} is not known", value));
    ring.mode.push_back(static_cast<TetherMode>(value));
  }
  const std::vector<double> rest_length = group.doubles("spring_rest_length");
  const std::vector<double> start_time = group.doubles("spring_start_time");
  const std::vector<double> reference_length = group.doubles("spring_reference_length");
  for (const auto* column : {&rest_length, &start_time, &reference_length})
    expect_size(column->size(), ring.vertex.size(), "purse_string/spring_*");
  for (std::size_t j = 0; j < rest_length.size(); ++j)
    ring.spring.push_back({rest_length[j], start_time[j], reference_length[j]});
  ring.shrink_rate = group.number("shrink_rate");
  ring.minimum_rest_length = group.number("minimum_rest_length");
  return ring;
}

}  // namespace

void write_tissue(const Hdf5Group& group, const Tissue& tissue, std::span<const double> reference_rest_length) {
  std::vector<int> first_vertex;
  for (int cell = 0; cell < tissue.cell_count(); ++cell) first_vertex.push_back(tissue.first_vertex(cell));
  first_vertex.push_back(tissue.vertex_count());
  group.write("first_vertex", first_vertex,
              {"1", "vertices of cell i: first_vertex[i] to first_vertex[i + 1] - 1, counter-clockwise"});
  group.write("initial_rest_length", tissue.initial_rest_lengths(), {"length", "l0(0) of each segment"});
  group.write("reference_rest_length", reference_rest_length, {"length", "l0_ref of shape memory; empty: l0(0)"});
  const Hdf5Group materials = group.create_group("material");
  for (const MaterialColumn& column : material_columns) {
    std::vector<double> values;
    for (int cell = 0; cell < tissue.cell_count(); ++cell) values.push_back(tissue.material(cell).*column.member);
    materials.write(column.name, values, column.label);
  }
}

StoredTissue read_tissue(const Hdf5Group& group) {
  const std::vector<int> first_vertex = group.integers("first_vertex");
  if (first_vertex.empty() || first_vertex.front() != 0) throw FileError("'first_vertex' does not start at 0");
  std::vector<double> initial_rest_length = group.doubles("initial_rest_length");
  std::vector<int> counts;
  for (std::size_t cell = 0; cell + 1 < first_vertex.size(); ++cell) {
    if (first_vertex[cell + 1] <= first_vertex[cell]) throw FileError("'first_vertex' does not increase");
    counts.push_back(first_vertex[cell + 1] - first_vertex[cell]);
  }
  // Also keeps Tissue from allocating what a damaged first_vertex claims.
  expect_size(initial_rest_length.size(), static_cast<std::size_t>(first_vertex.back()), "initial_rest_length");
  const Hdf5Group material = group.group("material");
  std::vector<CellMaterial> materials(counts.size());
  for (const MaterialColumn& column : material_columns) {
    const std::vector<double> values = material.doubles(column.name);
    expect_size(values.size(), materials.size(), column.name);
    for (std::size_t cell = 0; cell < values.size(); ++cell) materials[cell].*column.member = values[cell];
  }
  StoredTissue stored{.tissue = Tissue(counts, std::move(materials), std::move(initial_rest_length)),
                      .reference_rest_length = group.doubles("reference_rest_length")};
  if (!stored.reference_rest_length.empty())
    expect_size(stored.reference_rest_length.size(), stored.tissue.vertex_count(), "reference_rest_length");
  return stored;
}

void write_configuration(const Hdf5Group& group, const TissueState& state) {
  const StateView view = state.view();
  const std::size_t vertices = state.tissue.vertex_count();
  const std::array<std::span<const double>, 2> position{view.x.first(vertices), view.y.first(vertices)};
  group.write("time", state.time, {"time", "simulation time"});
  group.write_table("position", position, {"length", "cell vertices, cell after cell: x, y"});
  group.write("rest_length", view.rest_length,
              {"length", "l0 of the segment from each vertex to the next of its cell"});
  write_purse_string(group.create_group("purse_string"), state);
}

StoredConfiguration read_configuration(const Hdf5Group& group, int vertices) {
  StoredConfiguration stored;
  stored.time = group.number("time");
  const Hdf5Group ring_group = group.group("purse_string");
  stored.purse_string = read_purse_string(ring_group);
  const std::size_t cells = vertices, ring = stored.purse_string.size();
  const std::vector<double> position = group.pairs("position");
  const std::vector<double> ring_position = ring_group.pairs("position");
  const std::vector<double> rest_length = group.doubles("rest_length");
  expect_size(position.size(), 2 * cells, "position");
  expect_size(ring_position.size(), 2 * ring, "purse_string/position");
  expect_size(rest_length.size(), cells, "rest_length");
  for (const int vertex : stored.purse_string.vertex)
    if (vertex < 0 || vertex >= vertices)
      throw FileError(fmt::format("a tether holds vertex {} of {}", vertex, vertices));
  const StateLayout layout{vertices, static_cast<int>(ring)};
  stored.values.resize(layout.size());
  const MutableStateView view(layout, stored.values);
  std::copy_n(position.begin(), cells, view.x.begin());
  std::copy_n(position.begin() + cells, cells, view.y.begin());
  std::copy_n(ring_position.begin(), ring, view.x.begin() + cells);
  std::copy_n(ring_position.begin() + ring, ring, view.y.begin() + cells);
  std::copy(rest_length.begin(), rest_length.end(), view.rest_length.begin());
  return stored;
}

std::string stage_name(Stage stage) {
  switch (stage) {
    case Stage::packing:
      return "packing";
    case Stage::anneal:
      return "anneal";
    case Stage::ablation:
      return "ablation";
    case Stage::closure:
      return "closure";
  }
  throw FileError(fmt::format("stage {} has no name", static_cast<int>(stage)));
}

}  // namespace suture
