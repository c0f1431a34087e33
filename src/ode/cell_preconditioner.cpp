#include "ode/cell_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace suture {

namespace {

constexpr int width = 8;
constexpr std::size_t batches_per_range = 8;

}  // namespace

template <class Task>
void CellPreconditioner::for_each_batch(WorkerPool& workers, const Task& task) {
  const Ranges ranges{batches_.size(), batches_per_range};
  workers.for_each(ranges.count(), [&](int k) {
    for (std::size_t b = ranges[k].begin; b < ranges[k].end; ++b) task(batches_[b], k);
  });
}

CellPreconditioner::CellPreconditioner(const Tissue& tissue, const PaddedTissue& padded, int ring_size,
                                       const kernels::Table& kernel)
    : tissue_(&tissue), padded_(&padded), kernel_(&kernel), ring_size_(ring_size) {}

void CellPreconditioner::make_batches() {
  std::vector<int> order(tissue_->cell_count());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return tissue_->vertex_count(a) < tissue_->vertex_count(b); });
  for (std::size_t k = 0; k < order.size(); k += width) {
    Batch batch;
    batch.lanes = width;
    for (std::size_t j = k; j < std::min(k + width, order.size()); ++j) {
      batch.cell.push_back(order[j]);
      batch.matrix.rows = std::max(batch.matrix.rows, tissue_->vertex_count(order[j]));
    }
    for (const int cell : batch.cell) batch.lead.push_back(batch.matrix.rows - tissue_->vertex_count(cell));
    batches_.push_back(std::move(batch));
  }
  for (Batch& batch : batches_) allocate(batch);
  allocate_scratch();
  const int ring_size = std::exchange(ring_size_, 0);
  set_ring_size(ring_size);
}

void CellPreconditioner::set_ring_size(int ring_size) {
  if (batches_.empty()) {
    ring_size_ = ring_size;
    return;
  }
  if (ring_size_ > 0) {
    batches_.pop_back();
    buffers_.pop_back();
  }
  ring_size_ = ring_size;
  if (ring_size == 0) return;
  Batch ring;
  ring.matrix.rows = ring_size;
  allocate(ring);
  batches_.push_back(std::move(ring));
}

void CellPreconditioner::allocate(Batch& batch) {
  const std::size_t blocks = static_cast<std::size_t>(batch.matrix.rows) * 4 * batch.lanes, vectors = blocks / 2;
  AlignedBuffer buffer(5 * blocks + 3 * vectors + 64);
  batch.matrix.diagonal = buffer.take(blocks);
  batch.matrix.lower1 = buffer.take(blocks);
  batch.matrix.lower2 = buffer.take(blocks);
  batch.matrix.border = buffer.take(2 * blocks);
  batch.area_solution = buffer.take(vectors);
  batch.area_gradient = buffer.take(vectors);
  batch.rhs = buffer.take(vectors);
  batch.gain.assign(batch.lanes, 0.0);
  buffers_.push_back(std::move(buffer));
}

void CellPreconditioner::allocate_scratch() {
  int rows = 0;
  for (const Batch& batch : batches_) rows = std::max(rows, batch.matrix.rows);
  const std::size_t lane_order = static_cast<std::size_t>(rows + 1) * width, slots = 4 * static_cast<std::size_t>(padded_->slots());
  const std::size_t ranges = batches_.size() / batches_per_range + 1;  // the ring may begin another one
  scratch_ = AlignedBuffer(ranges * (8 * lane_order + 3 * width) + slots);
  rows_.resize(ranges);
  for (kernels::CellRows& range : rows_) {
    for (double** array : {&range.sxx, &range.sxy, &range.syy, &range.nx, &range.ny, &range.diagonal_xx, &range.diagonal_xy,
                           &range.diagonal_yy})
      *array = scratch_.take(lane_order) + width;  // row -1
    for (double** array : {&range.lead, &range.pressure, &range.bending_stiffness}) *array = scratch_.take(width);
  }
  diagonal_ = scratch_.take(slots);
}

void CellPreconditioner::make_identity(Batch& batch) {
  const std::size_t blocks = static_cast<std::size_t>(batch.matrix.rows) * 4 * batch.lanes;
  const kernels::CyclicBatch& m = batch.matrix;
  for (double* array : {m.diagonal, m.lower1, m.lower2, m.border}) std::fill_n(array, array == m.border ? 2 * blocks : blocks, 0.0);
  for (int row = 0; row < batch.matrix.rows; ++row)
    for (const int component : {0, 3})
      std::fill_n(batch.matrix.diagonal + (row * 4 + component) * batch.lanes, batch.lanes, 1.0);
}

void CellPreconditioner::add(Batch& batch, int lane, int row, int column, double xx, double xy, double yx, double yy) {
  const kernels::CyclicBatch& m = batch.matrix;
  if (row < column) {
    std::swap(row, column);
    std::swap(xy, yx);
  }
  double* block = nullptr;
  if (row == column)
    block = m.diagonal + row * 4 * batch.lanes;
  else if (column == m.rows - 2)
    block = m.lower1 + row * 4 * batch.lanes;
  else if (row >= m.rows - 2)
    block = m.border + ((row - (m.rows - 2)) * m.rows + column) * 4 * batch.lanes;
  else if (row - column <= 2)
    block = (row - column == 1 ? m.lower1 : m.lower2) + row * 4 * batch.lanes;
  else
    return;  // beyond the band: left to conjugate gradients
  block += lane;
  block[0] += xx;
  block[batch.lanes] += xy;
  block[2 * batch.lanes] += yx;
  block[3 * batch.lanes] += yy;
}

void CellPreconditioner::sum_diagonal(const ContactFactors& contacts, std::span<const PointBlock> extra, WorkerPool& workers) {
  std::fill_n(diagonal_, 4 * static_cast<std::size_t>(padded_->slots()), 0.0);
  // Lists at work at once touch no common cell, hence no common slot.
  contacts.for_each_list(workers, [&](int, std::span<const kernels::ContactFactor> factors) {
    kernel_->contact_diagonal(factors.data(), factors.size(), diagonal_);
  });
  for (int c = 0; c < padded_->cells(); ++c) {
    double* a = diagonal_ + 4 * padded_->shell.base[c];
    const int n = 4 * padded_->shell.count[c];
    for (int k = 4 * kernels::halo - 1; k >= 4; --k) a[k] += a[n + k];
    for (int k = 0; k < 4; ++k) a[n + k] += a[k];
  }
  for (const PointBlock& e : extra) {
    if (e.i != e.j || e.i >= tissue_->vertex_count()) continue;
    double* a = diagonal_ + 4 * padded_->slot(e.i);
    a[0] += e.block[0], a[1] += e.block[1], a[2] += e.block[3];
  }
}

void CellPreconditioner::gather(Batch& batch, kernels::CellRows& rows) {
  const kernels::ShellHessian& h = padded_->hessian;
  std::fill_n(rows.lead, width, static_cast<double>(batch.matrix.rows));
  for (std::size_t lane = 0; lane < batch.cell.size(); ++lane) {
    const int cell = batch.cell[lane], lead = batch.lead[lane], n = tissue_->vertex_count(cell);
    const int slot = padded_->shell.base[cell] + 1;
    rows.lead[lane] = lead;
    rows.pressure[lane] = h.pressure[cell];
    rows.bending_stiffness[lane] = padded_->shell.bending_stiffness[cell];
    for (const auto& [from, to] : {std::pair{h.sxx, rows.sxx}, {h.sxy, rows.sxy}, {h.syy, rows.syy}, {h.nx, rows.nx}, {h.ny, rows.ny}}) {
      double* out = to + lead * width + lane;
      for (int k = 0; k < n; ++k) out[k * width] = from[slot + k];
      out[-width] = from[slot + n - 1];
    }
    for (int k = 0; k < n; ++k) {
      const double* from = diagonal_ + 4 * (slot + k);
      const std::size_t row = static_cast<std::size_t>(lead + k), to = row * width + lane;
      rows.diagonal_xx[to] = from[0], rows.diagonal_xy[to] = from[1], rows.diagonal_yy[to] = from[2];
      batch.area_gradient[2 * row * width + lane] = h.ax[slot + k];
      batch.area_gradient[(2 * row + 1) * width + lane] = h.ay[slot + k];
    }
  }
}

/// The couplings of the last two vertices with the first two.
void CellPreconditioner::close_ring(Batch& batch, int lane, double gamma) {
  const int cell = batch.cell[lane], n = tissue_->vertex_count(cell), first = batch.lead[lane], last = first + n - 1;
  const kernels::ShellHessian& h = padded_->hessian;
  const int s = padded_->shell.base[cell] + n;  // slot of the last vertex; s + 1 repeats the first
  const double kb = gamma * padded_->shell.bending_stiffness[cell], half = 0.5 * gamma * h.pressure[cell];
  const double ux = h.nx[s - 1], uy = h.ny[s - 1], wx = h.nx[s], wy = h.ny[s], qx = h.nx[s + 1], qy = h.ny[s + 1];
  const double vx = -ux - wx, vy = -uy - wy, tx = -wx - qx, ty = -wy - qy;
  add(batch, lane, last, first, kb * (vx * wx + wx * tx) - gamma * h.sxx[s], kb * (vx * wy + wx * ty) - gamma * h.sxy[s] + half,
      kb * (vy * wx + wy * tx) - gamma * h.sxy[s] - half, kb * (vy * wy + wy * ty) - gamma * h.syy[s]);
  add(batch, lane, last - 1, first, kb * ux * wx, kb * ux * wy, kb * uy * wx, kb * uy * wy);
  add(batch, lane, last, first + 1, kb * wx * qx, kb * wx * qy, kb * wy * qx, kb * wy * qy);
}

/// Rank-one area term by Sherman-Morrison: (M + k g g^T)^-1 = M^-1 - q k q^T/(1 + k g.q), q = M^-1 g.
void CellPreconditioner::factor_area(Batch& batch, double gamma) {
  const int entries = 2 * batch.matrix.rows;
  std::copy_n(batch.area_gradient, entries * width, batch.area_solution);
  kernel_->cyclic_solve8(batch.matrix, batch.area_solution);
  for (std::size_t lane = 0; lane < batch.cell.size(); ++lane) {
    double product = 0.0;
    for (int k = 0; k < entries; ++k) product += batch.area_gradient[k * width + lane] * batch.area_solution[k * width + lane];
    const double k = gamma * padded_->hessian.area_curvature[batch.cell[lane]];
    batch.gain[lane] = k / (1.0 + k * product);
  }
}

void CellPreconditioner::set_up_cells(Batch& batch, kernels::CellRows& rows, double gamma) {
  gather(batch, rows);
  kernel_->cell_rows8(rows, gamma, batch.matrix);
  for (std::size_t lane = 0; lane < batch.cell.size(); ++lane) close_ring(batch, static_cast<int>(lane), gamma);
  kernel_->cyclic_factor8(batch.matrix);
  factor_area(batch, gamma);
}

void CellPreconditioner::set_up_ring(Batch& batch, double gamma, std::span<const PointBlock> extra) {
  make_identity(batch);
  const int vertices = tissue_->vertex_count();
  for (const PointBlock& e : extra) {
    if (e.i < vertices || e.j < vertices) continue;
    const auto [xx, xy, yx, yy] = e.block;
    add(batch, 0, e.i - vertices, e.j - vertices, gamma * xx, gamma * xy, gamma * yx, gamma * yy);
  }
  kernel_->cyclic_factor1(batch.matrix);
}

void CellPreconditioner::set_up(double gamma, const ContactFactors& contacts, std::span<const PointBlock> extra,
                                WorkerPool& workers) {
  if (batches_.empty()) make_batches();
  sum_diagonal(contacts, extra, workers);
  for_each_batch(workers, [&](Batch& batch, int range) {
    if (batch.lanes == 1)
      set_up_ring(batch, gamma, extra);
    else
      set_up_cells(batch, rows_[range], gamma);
  });
}

void CellPreconditioner::apply_ring(Batch& ring, std::span<const double> r, std::span<double> z) const {
  const int rows = ring.matrix.rows, first = tissue_->vertex_count(), points = first + ring_size_;
  for (int k = 0; k < rows; ++k) ring.rhs[2 * k] = r[first + k], ring.rhs[2 * k + 1] = r[points + first + k];
  kernel_->cyclic_solve1(ring.matrix, ring.rhs);
  for (int k = 0; k < rows; ++k) z[first + k] = ring.rhs[2 * k], z[points + first + k] = ring.rhs[2 * k + 1];
}

void CellPreconditioner::apply_cells(Batch& batch, std::span<const double> r, std::span<double> z) const {
  const int rows = batch.matrix.rows, points = tissue_->vertex_count() + ring_size_;
  for (std::size_t lane = 0; lane < batch.cell.size(); ++lane) {
    const int first = tissue_->first_vertex(batch.cell[lane]), lead = batch.lead[lane];
    double* out = batch.rhs + lane;
    for (int k = 0; k < rows - lead; ++k) {
      out[2 * (lead + k) * width] = r[first + k];
      out[(2 * (lead + k) + 1) * width] = r[points + first + k];
    }
  }
  kernel_->cyclic_solve8(batch.matrix, batch.rhs);
  double area[width] = {};
  for (int k = 0; k < 2 * rows; ++k)
    for (int lane = 0; lane < width; ++lane) area[lane] += batch.area_gradient[k * width + lane] * batch.rhs[k * width + lane];
  for (int lane = 0; lane < width; ++lane) area[lane] *= batch.gain[lane];
  for (std::size_t lane = 0; lane < batch.cell.size(); ++lane) {
    const int first = tissue_->first_vertex(batch.cell[lane]), lead = batch.lead[lane];
    const double *in = batch.rhs + lane, *q = batch.area_solution + lane;
    for (int k = 0; k < rows - lead; ++k) {
      const int x = 2 * (lead + k) * width, y = x + width;
      z[first + k] = in[x] - area[lane] * q[x];
      z[points + first + k] = in[y] - area[lane] * q[y];
    }
  }
}

void CellPreconditioner::apply(std::span<const double> r, std::span<double> z, WorkerPool& workers) {
  for_each_batch(workers, [&](Batch& batch, int) { batch.lanes == 1 ? apply_ring(batch, r, z) : apply_cells(batch, r, z); });
}

}  // namespace suture
