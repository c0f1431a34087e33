// Blocks of kernels::CyclicBatch, one by one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "kernels/aligned_buffer.hpp"
#include "kernels/kernels.hpp"

namespace suture {

/// What allocate() takes from a buffer, rounding up included.
inline std::size_t cyclic_size(int rows, int lanes) { return 5 * (static_cast<std::size_t>(rows) * 4 * lanes + 8); }

/// Room for `rows` rows of `lanes` matrices, zero when the buffer is new.
inline kernels::CyclicBatch allocate_cyclic(AlignedBuffer& buffer, int rows, int lanes) {
  const std::size_t blocks = static_cast<std::size_t>(rows) * 4 * lanes;
  kernels::CyclicBatch m;
  m.rows = rows;
  m.diagonal = buffer.take(blocks);
  m.lower1 = buffer.take(blocks);
  m.lower2 = buffer.take(blocks);
  m.border = buffer.take(2 * blocks);
  return m;
}

/// Adds a block at (row, column) of one lane; one beyond the band is left to conjugate gradients.
inline void add_block(const kernels::CyclicBatch& m, int lanes, int lane, int row, int column, double xx, double xy, double yx, double yy) {
  if (row < column) {
    std::swap(row, column);
    std::swap(xy, yx);
  }
  double* block = nullptr;
  if (row == column)
    block = m.diagonal + row * 4 * lanes;
  else if (column == m.rows - 2)
    block = m.lower1 + row * 4 * lanes;
  else if (row >= m.rows - 2)
    block = m.border + ((row - (m.rows - 2)) * m.rows + column) * 4 * lanes;
  else if (row - column <= 2)
    block = (row - column == 1 ? m.lower1 : m.lower2) + row * 4 * lanes;
  else
    return;
  block += lane;
  block[0] += xx;
  block[lanes] += xy;
  block[2 * lanes] += yx;
  block[3 * lanes] += yy;
}

}  // namespace suture
