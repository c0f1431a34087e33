#include "suture/physics/rest_length_flow.hpp"

#include "physics/numerical_failure.hpp"

namespace suture {

void add_rest_length_rate(const Tissue& tissue, std::span<const double> reference, const StateView& state,
                          MutableStateView rate) {
  const std::span<const double> memory_of = reference.empty() ? tissue.initial_rest_lengths() : reference;
  for (int v = 0; v < tissue.vertex_count(); ++v) {
    const CellMaterial& material = tissue.material(tissue.cell_of(v));
    const double length = norm(point_at(state, tissue.next(v)) - point_at(state, v));
    rate.rest_length[v] += rest_length_rate(state.rest_length[v], length, memory_of[v], material.tau, material.memory);
  }
}

}  // namespace suture
