#include "ode/ring_factors.hpp"

#include "ode/cyclic_blocks.hpp"

namespace suture {

RingFactors::RingFactors(int first, int size) : first_(first), size_(size), buffer_(cyclic_size(size, 1) + 2 * size + 8) {
  matrix_ = allocate_cyclic(buffer_, size, 1);
  rhs_ = buffer_.take(2 * size);
}

void RingFactors::set_up(double gamma, std::span<const PointBlock> blocks, const kernels::Table& kernel) {
  const std::size_t entries = 4 * static_cast<std::size_t>(size_);
  for (double* array : {matrix_.diagonal, matrix_.lower1, matrix_.lower2}) std::fill_n(array, entries, 0.0);
  std::fill_n(matrix_.border, 2 * entries, 0.0);
  for (int row = 0; row < size_; ++row) matrix_.diagonal[4 * row] = matrix_.diagonal[4 * row + 3] = 1.0;
  for (const PointBlock& e : blocks) {
    if (e.i < first_ || e.j < first_) continue;
    const auto [xx, xy, yx, yy] = e.block;
    add_block(matrix_, 1, 0, e.i - first_, e.j - first_, gamma * xx, gamma * xy, gamma * yx, gamma * yy);
  }
  kernel.cyclic_factor1(matrix_);
}

void RingFactors::apply(std::span<const double> r, std::span<double> z, const kernels::Table& kernel) const {
  const int points = first_ + size_;
  for (int k = 0; k < size_; ++k) rhs_[2 * k] = r[first_ + k], rhs_[2 * k + 1] = r[points + first_ + k];
  kernel.cyclic_solve1(matrix_, rhs_);
  for (int k = 0; k < size_; ++k) z[first_ + k] = rhs_[2 * k], z[points + first_ + k] = rhs_[2 * k + 1];
}

}  // namespace suture
