#include "ode/cell_preconditioner.hpp"

#include <algorithm>
#include <numeric>

#include "suture/errors.hpp"

namespace suture {

template <class Task>
void CellPreconditioner::for_each_batch(WorkerPool& workers, const Task& task) {
  workers.for_each(ranges_.count(), [&](int k) {
    for (std::size_t b = ranges_[k].begin; b < ranges_[k].end; ++b) task(batches_[b], rooms_[k]);
  });
}

CellPreconditioner::CellPreconditioner(const Tissue& tissue, const PaddedTissue& padded, int ring_size, const kernels::Table& kernel)
    : tissue_(&tissue), padded_(&padded), kernel_(&kernel), ring_size_(ring_size) {}

void CellPreconditioner::make_batches() {
  std::vector<int> order(tissue_->cell_count());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return tissue_->vertex_count(a) < tissue_->vertex_count(b); });
  for (std::size_t k = 0; k < order.size(); k += CellBatch::most_cells)
    batches_.emplace_back(std::span(order).subspan(k, std::min<std::size_t>(CellBatch::most_cells, order.size() - k)), *tissue_);
  constexpr std::size_t shortest = 4, most_ranges = 64;
  ranges_ = {batches_.size(), std::max(shortest, (batches_.size() + most_ranges - 1) / most_ranges)};
  for (int k = 0; k < ranges_.count(); ++k) rooms_.emplace_back(tissue_->vertex_count(order.back()));
  set_ring_size(ring_size_);
}

void CellPreconditioner::set_ring_size(int ring_size) {
  ring_size_ = ring_size;
  if (!batches_.empty()) ring_ = ring_size > 0 ? RingFactors(tissue_->vertex_count(), ring_size) : RingFactors();
}

/// The four arrays of a product lie one behind the other, and are made anew for every product.
double* CellPreconditioner::diagonal() const {
  const kernels::ShellHessian& h = padded_->hessian;
  SUTURE_EXPECTS(h.vx + padded_->slots() <= h.vy && h.vy + padded_->slots() <= h.ox && h.ox + padded_->slots() <= h.oy);
  return h.vx;
}

void CellPreconditioner::sum_diagonal(const ContactFactors& contacts, std::span<const PointBlock> extra, WorkerPool& workers) {
  double* const diagonal = this->diagonal();
  std::fill_n(diagonal, 4 * static_cast<std::size_t>(padded_->slots()), 0.0);
  // Lists at work at once touch no common cell, hence no common slot.
  contacts.for_each_list(workers, [&](int, std::span<const kernels::ContactFactor> factors) {
    kernel_->contact_diagonal(factors.data(), factors.size(), diagonal);
  });
  for (int c = 0; c < padded_->cells(); ++c) {
    double* a = diagonal + 4 * padded_->shell.base[c];
    const int n = 4 * padded_->shell.count[c];
    for (int k = 4 * kernels::halo - 1; k >= 4; --k) a[k] += a[n + k];
    for (int k = 0; k < 4; ++k) a[n + k] += a[k];
  }
  for (const PointBlock& e : extra) {
    if (e.i != e.j || e.i >= tissue_->vertex_count()) continue;
    double* a = diagonal + 4 * padded_->slot(e.i);
    a[0] += e.block[0], a[1] += e.block[1], a[2] += e.block[3];
  }
}

void CellPreconditioner::set_up(double gamma, const ContactFactors& contacts, std::span<const PointBlock> extra, WorkerPool& workers) {
  if (batches_.empty()) make_batches();
  sum_diagonal(contacts, extra, workers);
  for_each_batch(workers, [&](CellBatch& batch, FactorRoom& room) { batch.set_up(gamma, *padded_, diagonal(), *kernel_, room); });
  if (ring_size_ > 0) ring_.set_up(gamma, extra, *kernel_);
}

void CellPreconditioner::apply(std::span<const double> r, std::span<double> z, WorkerPool& workers) {
  const std::size_t points = r.size() / 2;
  for_each_batch(workers, [&](CellBatch& batch, FactorRoom& room) { batch.apply(r.data(), z.data(), points, *kernel_, room); });
  if (ring_size_ > 0) ring_.apply(r, z, *kernel_);
}

}  // namespace suture
