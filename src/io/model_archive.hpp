// The fields of the model's own types, for byte_archive.hpp.
#pragma once

#include "io/byte_archive.hpp"
#include "suture/geometry/point.hpp"
#include "suture/integrate/integrator.hpp"
#include "suture/model/state.hpp"

namespace suture {

template <class Archive>
void exchange_fields(Archive& archive, Point& p) {
  archive(p.x, p.y);
}

template <class Archive>
void exchange_fields(Archive& archive, CellMaterial& m) {
  archive(m.rest_area, m.area_stiffness, m.membrane_stiffness, m.bending_stiffness, m.tau, m.memory);
}

template <class Archive>
void exchange_fields(Archive& archive, ChainSpring& s) {
  archive(s.rest_length, s.start_time, s.reference_length);
}

template <class Archive>
void exchange_fields(Archive& archive, PurseString& ring) {
  archive(ring.vertex, ring.spring, ring.mode, ring.shrink_rate, ring.minimum_rest_length);
  if constexpr (Archive::reading) {
    bool sound = ring.spring.size() == ring.vertex.size() && ring.mode.size() == ring.vertex.size();
    for (const TetherMode mode : ring.mode) sound = sound && (mode == TetherMode::attached || mode == TetherMode::slipped);
    if (!sound) throw FileError("the purse string contradicts itself");
  }
}

template <class Archive>
void exchange_fields(Archive& archive, SharedValues& shared) {
  std::vector<double> values;
  if constexpr (!Archive::reading) values = shared.to_vector();
  archive(values);
  if constexpr (Archive::reading) shared = std::move(values);
}

template <class Archive>
void exchange_fields(Archive& archive, Tissue& tissue) {
  std::vector<int> counts;
  std::vector<CellMaterial> materials;
  std::vector<double> rest_lengths;
  if constexpr (!Archive::reading) {
    for (int cell = 0; cell < tissue.cell_count(); ++cell) {
      counts.push_back(tissue.vertex_count(cell));
      materials.push_back(tissue.material(cell));
    }
    rest_lengths.assign(tissue.initial_rest_lengths().begin(), tissue.initial_rest_lengths().end());
  }
  archive(counts, materials, rest_lengths);
  if constexpr (Archive::reading) {
    std::size_t vertices = 0;
    for (const int count : counts) {
      if (count < 3) throw FileError("a cell has fewer than three vertices");
      vertices += static_cast<std::size_t>(count);
    }
    // Before Tissue allocates what damaged counts claim.
    if (vertices != rest_lengths.size() || materials.size() != counts.size())
      throw FileError("the parts of a tissue differ in size");
    tissue = counts.empty() ? Tissue() : Tissue(counts, std::move(materials), std::move(rest_lengths));
  }
}

template <class Archive>
void exchange_fields(Archive& archive, TissueState& state) {
  archive(state.tissue, state.purse_string, state.reference_rest_length, state.time, state.values);
  if constexpr (Archive::reading) {
    const std::size_t vertices = state.tissue.vertex_count(), reference = state.reference_rest_length.size();
    bool sound = state.values.size() == static_cast<std::size_t>(state.layout().size()) &&
                 (reference == 0 || reference == vertices);
    for (const int v : state.purse_string.vertex) sound = sound && v >= 0 && static_cast<std::size_t>(v) < vertices;
    if (!sound) throw FileError("the parts of a state differ in size");
  }
}

template <class Archive>
void exchange_fields(Archive& archive, Statistics& s) {
  archive(s.rate_evaluations, s.steps, s.newton_iterations, s.linear_iterations, s.hessian_builds,
          s.preconditioner_setups, s.error_test_failures, s.convergence_failures, s.restarts);
}

}  // namespace suture
