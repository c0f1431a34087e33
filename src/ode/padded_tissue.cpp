#include "ode/padded_tissue.hpp"

#include <cstring>

namespace suture {

PaddedTissue::PaddedTissue(const Tissue& tissue, SpringLaw law, int cells_per_block) {
  constexpr int first = 7, gap = 8;  // slot 1 of every cell begins an aligned vector
  const auto cells = static_cast<std::size_t>(tissue.cell_count());
  blocks_ = {cells, cells_per_block > 0 ? static_cast<std::size_t>(cells_per_block) : std::max<std::size_t>(cells, 1)};
  slots_ = first;
  for (int c = 0; c < tissue.cell_count(); ++c) {
    const int n = tissue.vertex_count(c);
    if (c > 0 && cells_per_block > 0 && c % cells_per_block == 0) slots_ += gap;  // blocks share no cache line
    base_.push_back(slots_);
    count_.push_back(n);
    for (int k = 0; k < n; ++k) slot_of_.push_back(slots_ + 1 + k);
    slots_ += (n + kernels::halo + 7) / 8 * 8;
    const CellMaterial& material = tissue.material(c);
    rest_area_.push_back(material.rest_area);
    area_stiffness_.push_back(material.area_stiffness);
    bending_stiffness_.push_back(material.bending_stiffness);
  }
  slots_ += 16;  // windows of eight that start at the last vertex
  vertex_of_.assign(slots_, 0);
  for (int c = 0; c < tissue.cell_count(); ++c)
    for (int k = 0; k < count_[c] + kernels::halo; ++k)
      vertex_of_[base_[c] + k] = tissue.first_vertex(c) + (k + count_[c] - 1) % count_[c];
  shell.relative_law = law == SpringLaw::relative;
  take_arrays(tissue);
}

void PaddedTissue::take_arrays(const Tissue& tissue) {
  area_.resize(base_.size());
  pressure_.resize(base_.size());
  area_curvature_.resize(base_.size());

  constexpr int arrays = 25;
  buffer_ = AlignedBuffer(static_cast<std::size_t>(arrays) * (slots_ + 8));
  double* stiffness = nullptr;
  for (double** array : {&shell.x, &shell.y, &shell.ex, &shell.ey, &shell.length, &shell.inverse_length, &shell.theta,
                         &shell.rest_a, &shell.rest_b, &stiffness, &shell.gx, &shell.gy, &hessian.sxx, &hessian.sxy,
                         &hessian.syy, &hessian.nx, &hessian.ny, &hessian.ax, &hessian.ay, &hessian.vx, &hessian.vy, &hessian.ox, &hessian.oy})
    *array = buffer_.take(slots_);
  shell.gradient = buffer_.take(2 * slots_);
  for (int c = 0; c < tissue.cell_count(); ++c)
    for (int k = 0; k < count_[c] + kernels::halo; ++k) {
      const double length = tissue.initial_rest_length(vertex_of_[base_[c] + k]);
      const double stiffness_k = tissue.material(c).membrane_stiffness;
      stiffness[base_[c] + k] = shell.relative_law ? stiffness_k : stiffness_k / (length * length);
    }
  shell.cells = tissue.cell_count();
  shell.base = base_.data();
  shell.count = count_.data();
  shell.rest_area = rest_area_.data();
  shell.area_stiffness = area_stiffness_.data();
  shell.bending_stiffness = bending_stiffness_.data();
  shell.stiffness = stiffness;
  shell.area = area_.data();
  hessian.pressure = pressure_.data();
  hessian.area_curvature = area_curvature_.data();
}

Range PaddedTissue::vertices_of(int block) const {
  const Range cells = blocks_[block];
  const auto first = static_cast<std::size_t>(vertex_of_[base_[cells.begin] + 1]);
  return {first, static_cast<std::size_t>(vertex_of_[base_[cells.end - 1] + 1] + count_[cells.end - 1])};
}

kernels::Shell PaddedTissue::shell_of(int block) const {
  const Range cells = blocks_[block];
  kernels::Shell part = shell;
  part.cells = static_cast<int>(cells.end - cells.begin);
  part.base += cells.begin;
  part.count += cells.begin;
  part.rest_area += cells.begin;
  part.area_stiffness += cells.begin;
  part.bending_stiffness += cells.begin;
  part.area += cells.begin;
  return part;
}

kernels::ShellHessian PaddedTissue::hessian_of(int block) const {
  kernels::ShellHessian part = hessian;
  part.pressure += blocks_[block].begin;
  part.area_curvature += blocks_[block].begin;
  return part;
}

void PaddedTissue::unpack(std::span<const double> values, double* padded, int block) const {
  const double* source = values.data() + vertices_of(block).begin;
  for (std::size_t c = blocks_[block].begin; c < blocks_[block].end; ++c) {
    std::memcpy(padded + base_[c] + 1, source, count_[c] * sizeof(double));
    repeat_ends(padded, static_cast<int>(c));
    source += count_[c];
  }
}

void PaddedTissue::fold_and_pack(double* padded, std::span<double> values, int block) const {
  kernels::best().fold_cells(shell_of(block), padded, values.data() + vertices_of(block).begin);
}

void PaddedTissue::pack_gradient(std::span<double> gx, std::span<double> gy, int block) const {
  const std::size_t first = vertices_of(block).begin;
  kernels::best().fold_gradient(shell_of(block), gx.data() + first, gy.data() + first);
}

void PaddedTissue::unpack(std::span<const double> values, double* padded) const {
  for (int b = 0; b < blocks(); ++b) unpack(values, padded, b);
}

void PaddedTissue::fold_and_pack(double* padded, std::span<double> values) const {
  for (int b = 0; b < blocks(); ++b) fold_and_pack(padded, values, b);
}

}  // namespace suture
