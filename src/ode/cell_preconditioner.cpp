#include "ode/cell_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace suture {

namespace {

constexpr int width = 8;

}  // namespace

CellPreconditioner::CellPreconditioner(const Tissue& tissue, const PaddedTissue& padded, int ring_size,
                                       const kernels::Table& kernel)
    : tissue_(&tissue), padded_(&padded), kernel_(&kernel), ring_size_(ring_size) {
  make_batches();
}

void CellPreconditioner::make_batches() {
  std::vector<int> order(tissue_->cell_count());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return tissue_->vertex_count(a) < tissue_->vertex_count(b); });
  batch_of_.resize(order.size());
  lane_of_.resize(order.size());
  for (std::size_t k = 0; k < order.size(); k += width) {
    Batch batch;
    batch.lanes = width;
    for (std::size_t j = k; j < std::min(k + width, order.size()); ++j) {
      batch_of_[order[j]] = static_cast<int>(batches_.size());
      lane_of_[order[j]] = static_cast<int>(j - k);
      batch.cell.push_back(order[j]);
      batch.matrix.rows = std::max(batch.matrix.rows, tissue_->vertex_count(order[j]));
    }
    for (const int cell : batch.cell) batch.lead.push_back(batch.matrix.rows - tissue_->vertex_count(cell));
    batches_.push_back(std::move(batch));
  }
  for (Batch& batch : batches_) allocate(batch);
  const int ring_size = std::exchange(ring_size_, 0);
  set_ring_size(ring_size);
}

void CellPreconditioner::set_ring_size(int ring_size) {
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

void CellPreconditioner::clear(Batch& batch) {
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

/// Membrane and bending in terms of segments, and the antisymmetric second derivative of the area.
void CellPreconditioner::add_shell(Batch& batch, int lane, double gamma) {
  const int cell = batch.cell[lane], lead = batch.lead[lane], n = tissue_->vertex_count(cell);
  const kernels::ShellHessian& h = padded_->hessian;
  const int b = padded_->shell.base[cell] + 1;
  const double kb = gamma * padded_->shell.bending_stiffness[cell], half = 0.5 * gamma * h.pressure[cell];
  for (int i = 0; i < n; ++i) {
    const int s = b + i, here = lead + i, next = lead + (i + 1) % n, before = lead + (i + n - 1) % n;
    const double sxx = gamma * h.sxx[s], sxy = gamma * h.sxy[s], syy = gamma * h.syy[s];
    add(batch, lane, here, here, sxx, sxy, sxy, syy);
    add(batch, lane, next, next, sxx, sxy, sxy, syy);
    add(batch, lane, here, next, -sxx, -sxy + half, -sxy - half, -syy);
    // theta_i depends on before, here, next through u = N_{i-1}, v = -(N_{i-1} + N_i), w = N_i.
    const double ux = h.nx[s - 1], uy = h.ny[s - 1], wx = h.nx[s], wy = h.ny[s], vx = -ux - wx, vy = -uy - wy;
    add(batch, lane, before, before, kb * ux * ux, kb * ux * uy, kb * ux * uy, kb * uy * uy);
    add(batch, lane, here, here, kb * vx * vx, kb * vx * vy, kb * vx * vy, kb * vy * vy);
    add(batch, lane, next, next, kb * wx * wx, kb * wx * wy, kb * wx * wy, kb * wy * wy);
    add(batch, lane, before, here, kb * ux * vx, kb * ux * vy, kb * uy * vx, kb * uy * vy);
    add(batch, lane, here, next, kb * vx * wx, kb * vx * wy, kb * vy * wx, kb * vy * wy);
    add(batch, lane, before, next, kb * ux * wx, kb * ux * wy, kb * uy * wx, kb * uy * wy);
    batch.area_gradient[(2 * here) * width + lane] = h.ax[s];
    batch.area_gradient[(2 * here + 1) * width + lane] = h.ay[s];
  }
}

void CellPreconditioner::add_contacts(double gamma, std::span<const kernels::ContactFactor> contacts) {
  for (const kernels::ContactFactor& f : contacts) {
    const double xx = gamma * f.na * f.nx * f.nx, xy = gamma * f.na * f.nx * f.ny, yy = gamma * f.na * f.ny * f.ny;
    const auto add_at = [&](int slot, double weight) {
      const int vertex = padded_->vertex(slot), cell = tissue_->cell_of(vertex);
      Batch& batch = batches_[batch_of_[cell]];
      const int row = batch.lead[lane_of_[cell]] + vertex - tissue_->first_vertex(cell);
      const double w = weight * weight;
      add(batch, lane_of_[cell], row, row, w * xx, w * xy, w * xy, w * yy);
    };
    add_at(f.p, 1.0);
    add_at(f.q, 1.0 - f.t);
    if (f.t > 0.0) add_at(f.q + 1, f.t);
  }
}

void CellPreconditioner::add_extra(double gamma, std::span<const PointBlock> extra) {
  const int vertices = tissue_->vertex_count();
  for (const PointBlock& e : extra) {
    const auto [xx, xy, yx, yy] = e.block;
    if (e.i < vertices && e.j < vertices) {
      if (e.i != e.j) continue;
      const int cell = tissue_->cell_of(e.i);
      Batch& batch = batches_[batch_of_[cell]];
      const int row = batch.lead[lane_of_[cell]] + e.i - tissue_->first_vertex(cell);
      add(batch, lane_of_[cell], row, row, gamma * xx, gamma * xy, gamma * yx, gamma * yy);
    } else if (e.i >= vertices && e.j >= vertices) {
      const int i = e.i - vertices, j = e.j - vertices;
      add(batches_.back(), 0, i, j, gamma * xx, gamma * xy, gamma * yx, gamma * yy);
    }
  }
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

template <class Task>
void CellPreconditioner::for_each_batch(WorkerPool& workers, const Task& task) {
  const Ranges ranges{batches_.size(), 8};
  workers.for_each(ranges.count(), [&](int k) {
    for (std::size_t b = ranges[k].begin; b < ranges[k].end; ++b) task(batches_[b]);
  });
}

void CellPreconditioner::factor(Batch& batch, double gamma) {
  if (batch.lanes == 1) {
    kernel_->cyclic_factor1(batch.matrix);
  } else {
    kernel_->cyclic_factor8(batch.matrix);
    factor_area(batch, gamma);
  }
}

void CellPreconditioner::set_up(double gamma, const ContactFactors& contacts, std::span<const PointBlock> extra,
                                WorkerPool& workers) {
  for_each_batch(workers, [&](Batch& batch) {
    clear(batch);
    for (std::size_t lane = 0; lane < batch.cell.size(); ++lane) add_shell(batch, static_cast<int>(lane), gamma);
  });
  // Tiles at work at once touch no common cell, hence no common lane.
  contacts.for_each_tile(workers, [&](std::span<const kernels::ContactFactor> factors) { add_contacts(gamma, factors); });
  add_extra(gamma, extra);
  for_each_batch(workers, [&](Batch& batch) { factor(batch, gamma); });
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
  for_each_batch(workers, [&](Batch& batch) { batch.lanes == 1 ? apply_ring(batch, r, z) : apply_cells(batch, r, z); });
}

}  // namespace suture
