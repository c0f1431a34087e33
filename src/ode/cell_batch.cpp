#include "ode/cell_batch.hpp"

#include <algorithm>
#include <utility>

#include "ode/cyclic_blocks.hpp"

namespace suture {

namespace {

constexpr int width = 8;  // cells factored side by side

}  // namespace

FactorRoom::FactorRoom(int most_rows) {
  const std::size_t lane_order = static_cast<std::size_t>(most_rows + 1) * width, vectors = 2 * static_cast<std::size_t>(most_rows) * width;
  buffer_ = AlignedBuffer(cyclic_size(most_rows, width) + 8 * (lane_order + 8) + 3 * width + 3 * (vectors + 8));
  matrix = allocate_cyclic(buffer_, most_rows, width);
  for (double** array : {&rows.sxx, &rows.sxy, &rows.syy, &rows.nx, &rows.ny, &rows.diagonal_xx, &rows.diagonal_xy, &rows.diagonal_yy})
    *array = buffer_.take(lane_order) + width;  // row -1
  for (double** array : {&rows.lead, &rows.pressure, &rows.bending_stiffness}) *array = buffer_.take(width);
  area_gradient = buffer_.take(vectors);
  area_solution = buffer_.take(vectors);
  rhs = reinterpret_cast<float*>(buffer_.take(vectors));  // twice as many of half the size
}

CellBatch::CellBatch(std::span<const int> cells, const Tissue& tissue) : cells_(cells.begin(), cells.end()) {
  for (const int cell : cells) counts_.push_back(tissue.vertex_count(cell));
  factors_.rows = *std::max_element(counts_.begin(), counts_.end());
  lanes_.cells = static_cast<int>(cells_.size());
  for (int lane = 0; lane < most_cells; ++lane) {
    const int k = lane < lanes_.cells ? lane : 0;
    lanes_.first[lane] = tissue.first_vertex(cells_[k]);
    lanes_.lead[lane] = factors_.rows - counts_[k];
    lanes_.common = std::max(lanes_.common, lanes_.lead[lane]);
  }
  const std::size_t blocks = static_cast<std::size_t>(factors_.rows) * 4 * most_cells;  // floats
  buffer_ = AlignedBuffer(3 * blocks + most_cells);
  const auto take = [this](std::size_t floats) { return reinterpret_cast<float*>(buffer_.take(floats / 2)); };
  for (float** array : {&factors_.diagonal, &factors_.lower1, &factors_.lower2}) *array = take(blocks);
  factors_.border = take(2 * blocks);
  factors_.area_gradient = take(blocks / 2);
  factors_.area_solution = take(blocks / 2);
  factors_.gain = take(most_cells);
}

void CellBatch::gather(Half half, const PaddedTissue& padded, const double* diagonal, FactorRoom& room) const {
  const kernels::ShellHessian& h = padded.hessian;
  kernels::CellRows& rows = room.rows;
  std::fill_n(rows.lead, width, static_cast<double>(factors_.rows));
  std::fill_n(room.area_gradient, 2 * factors_.rows * width, 0.0);
  for (int k = half.begin; k < half.end; ++k) {
    const int cell = cells_[k], lead = lanes_.lead[k], n = counts_[k], lane = k - half.begin, slot = padded.shell.base[cell] + 1;
    rows.lead[lane] = lead;
    rows.pressure[lane] = h.pressure[cell];
    rows.bending_stiffness[lane] = padded.shell.bending_stiffness[cell];
    for (const auto& [from, to] : {std::pair{h.sxx, rows.sxx}, {h.sxy, rows.sxy}, {h.syy, rows.syy}, {h.nx, rows.nx}, {h.ny, rows.ny}}) {
      double* out = to + lead * width + lane;
      for (int j = 0; j < n; ++j) out[j * width] = from[slot + j];
      out[-width] = from[slot + n - 1];
    }
    for (int j = 0; j < n; ++j) {
      const double* from = diagonal + 4 * (slot + j);
      const std::size_t row = static_cast<std::size_t>(lead + j), to = row * width + lane;
      rows.diagonal_xx[to] = from[0], rows.diagonal_xy[to] = from[1], rows.diagonal_yy[to] = from[2];
      room.area_gradient[2 * row * width + lane] = h.ax[slot + j];
      room.area_gradient[(2 * row + 1) * width + lane] = h.ay[slot + j];
    }
  }
}

/// The couplings of the last two vertices with the first two.
void CellBatch::close_ring(int k, double gamma, const PaddedTissue& padded, FactorRoom& room) const {
  const int cell = cells_[k], n = counts_[k], first = lanes_.lead[k], last = first + n - 1;
  const kernels::ShellHessian& h = padded.hessian;
  const int s = padded.shell.base[cell] + n;  // slot of the last vertex; s + 1 repeats the first
  const double kb = gamma * padded.shell.bending_stiffness[cell], half = 0.5 * gamma * h.pressure[cell];
  const double ux = h.nx[s - 1], uy = h.ny[s - 1], wx = h.nx[s], wy = h.ny[s], qx = h.nx[s + 1], qy = h.ny[s + 1];
  const double vx = -ux - wx, vy = -uy - wy, tx = -wx - qx, ty = -wy - qy;
  const auto add = [&](int row, int column, double xx, double xy, double yx, double yy) {
    add_block(room.matrix, width, k % width, row, column, xx, xy, yx, yy);
  };
  add(last, first, kb * (vx * wx + wx * tx) - gamma * h.sxx[s], kb * (vx * wy + wx * ty) - gamma * h.sxy[s] + half,
      kb * (vy * wx + wy * tx) - gamma * h.sxy[s] - half, kb * (vy * wy + wy * ty) - gamma * h.syy[s]);
  add(last - 1, first, kb * ux * wx, kb * ux * wy, kb * uy * wx, kb * uy * wy);
  add(last, first + 1, kb * wx * qx, kb * wx * qy, kb * wy * qx, kb * wy * qy);
}

/// Rank-one area term by Sherman-Morrison: (M + k g g^T)^-1 = M^-1 - q k q^T/(1 + k g.q), q = M^-1 g.
void CellBatch::factor_area(Half half, double gamma, const PaddedTissue& padded, const kernels::Table& kernel, FactorRoom& room) {
  const int entries = 2 * factors_.rows;
  std::copy_n(room.area_gradient, entries * width, room.area_solution);
  kernel.cyclic_solve8(room.matrix, room.area_solution);
  for (int k = half.begin; k < half.end; ++k) {
    double product = 0.0;
    for (int j = k % width; j < entries * width; j += width) product += room.area_gradient[j] * room.area_solution[j];
    const double curvature = gamma * padded.hessian.area_curvature[cells_[k]];
    factors_.gain[k] = static_cast<float>(curvature / (1.0 + curvature * product));
  }
}

void CellBatch::set_up(double gamma, const PaddedTissue& padded, const double* diagonal, const kernels::Table& kernel, FactorRoom& room) {
  room.matrix.rows = factors_.rows;
  for (int begin = 0; begin < most_cells; begin += width) {
    const Half half{begin, std::clamp(lanes_.cells, begin, begin + width)};
    gather(half, padded, diagonal, room);
    kernel.cell_rows8(room.rows, gamma, room.matrix);
    for (int k = half.begin; k < half.end; ++k) close_ring(k, gamma, padded, room);
    kernel.cyclic_factor8(room.matrix);
    factor_area(half, gamma, padded, kernel, room);
    kernel.narrow_cells(room.matrix, room.area_gradient, room.area_solution, begin / width, factors_);
  }
}

void CellBatch::apply(const double* r, double* z, std::size_t points, const kernels::Table& kernel, FactorRoom& room) const {
  kernel.apply_cells(factors_, lanes_, r, z, points, room.rhs);
}

}  // namespace suture
