#include "suture/model/tissue.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "suture/errors.hpp"

namespace suture {

namespace {

/// Before anything is allocated for them.
void check_sizes(const std::vector<int>& vertex_counts, std::size_t materials, std::size_t rest_lengths) {
  if (vertex_counts.size() != materials) throw InputError(fmt::format("{} cells but {} materials", vertex_counts.size(), materials));
  std::size_t segments = 0;
  for (std::size_t cell = 0; cell < vertex_counts.size(); ++cell) {
    const int count = vertex_counts[cell];
    if (count < 3) throw InputError(fmt::format("cell {} has {} vertices; at least 3 are needed", cell, count));
    segments += static_cast<std::size_t>(count);
  }
  if (rest_lengths != segments) throw InputError(fmt::format("{} segments but {} rest lengths", segments, rest_lengths));
}

}  // namespace

struct Tissue::Segments {
  std::vector<int> first{0}, cell_of;
  std::vector<double> initial_rest_lengths;
};

Tissue::Tissue(const std::vector<int>& vertex_counts, std::vector<CellMaterial> materials,
               std::vector<double> initial_rest_lengths) {
  check_sizes(vertex_counts, materials.size(), initial_rest_lengths.size());
  auto segments = std::make_shared<Segments>();
  segments->first.reserve(vertex_counts.size() + 1);
  segments->cell_of.reserve(initial_rest_lengths.size());
  for (std::size_t cell = 0; cell < vertex_counts.size(); ++cell) {
    segments->first.push_back(segments->first.back() + vertex_counts[cell]);
    segments->cell_of.insert(segments->cell_of.end(), vertex_counts[cell], static_cast<int>(cell));
  }
  segments->initial_rest_lengths = std::move(initial_rest_lengths);
  first_ = segments->first, cell_of_ = segments->cell_of, initial_rest_lengths_ = segments->initial_rest_lengths;
  segments_ = std::move(segments);
  hold(std::move(materials));
  for (int v = 0; v < vertex_count(); ++v)
    if (!(initial_rest_lengths_[v] > 0.0))
      throw InputError(fmt::format("{}: the rest length {} is not positive", vertex_name(v), initial_rest_lengths_[v]));
  if (!cell_of_.empty())
    mean_initial_rest_length_ =
        std::accumulate(initial_rest_lengths_.begin(), initial_rest_lengths_.end(), 0.0) / vertex_count();
}

void Tissue::hold(std::vector<CellMaterial> materials) {
  held_materials_ = std::make_shared<const std::vector<CellMaterial>>(std::move(materials));
  materials_ = *held_materials_;
}

std::string Tissue::vertex_name(int vertex) const {
  const int cell = cell_of_[vertex];
  return fmt::format("cell {}, vertex {}", cell, vertex - first_[cell]);
}

Tissue Tissue::subset(const std::vector<int>& keep) const {
  std::vector<int> counts;
  std::vector<CellMaterial> materials;
  std::vector<double> rest_lengths;
  for (const int cell : keep) {
    counts.push_back(vertex_count(cell));
    materials.push_back(materials_[cell]);
    rest_lengths.insert(rest_lengths.end(), initial_rest_lengths_.begin() + first_[cell],
                        initial_rest_lengths_.begin() + first_[cell + 1]);
  }
  return {counts, std::move(materials), std::move(rest_lengths)};
}

Tissue Tissue::with_materials(std::vector<CellMaterial> materials) const {
  SUTURE_EXPECTS(materials.size() == materials_.size());
  Tissue copy = *this;
  copy.hold(std::move(materials));
  return copy;
}

double regular_rest_length(int vertices, double rest_area, double shape_parameter) {
  const double n = vertices;
  return std::sqrt(4.0 * n * std::tan(std::numbers::pi / n) * shape_parameter * rest_area) / n;
}

Tissue make_tissue(const Config& config) {
  std::vector<int> counts;
  std::vector<CellMaterial> materials;
  std::vector<double> rest_lengths;
  const auto add_cells = [&](int cells, int vertices, double shape, const CellMaterial& material) {
    const double length = regular_rest_length(vertices, material.rest_area, shape);
    counts.insert(counts.end(), cells, vertices);
    materials.insert(materials.end(), cells, material);
    rest_lengths.insert(rest_lengths.end(), static_cast<std::size_t>(cells) * vertices, length);
  };
  const CellMaterial base{.rest_area = 1.0,
                          .area_stiffness = config.area.stiffness,
                          .membrane_stiffness = config.membrane.stiffness,
                          .bending_stiffness = config.bending.stiffness,
                          .tau = config.plasticity.tau,
                          .memory = config.plasticity.memory};
  int remaining = config.tissue.cells;
  for (const CellType& type : config.cell_types) {
    CellMaterial material = base;
    material.rest_area = type.rest_area.value_or(base.rest_area);
    material.area_stiffness = type.area_stiffness.value_or(base.area_stiffness);
    material.membrane_stiffness = type.membrane_stiffness.value_or(base.membrane_stiffness);
    material.bending_stiffness = type.bending_stiffness.value_or(base.bending_stiffness);
    material.tau = type.tau.value_or(base.tau);
    material.memory = type.memory.value_or(base.memory);
    add_cells(type.cells, type.vertices.value_or(config.tissue.vertices),
              type.shape_parameter.value_or(config.tissue.shape_parameter), material);
    remaining -= type.cells;
  }
  if (remaining < 0)
    throw InputError(fmt::format("[[cell_type]] tables ask for {} cells, but tissue.cells is {}",
                                 config.tissue.cells - remaining, config.tissue.cells));
  add_cells(remaining, config.tissue.vertices, config.tissue.shape_parameter, base);
  return {counts, std::move(materials), std::move(rest_lengths)};
}

}  // namespace suture
