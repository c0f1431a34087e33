// The purse string's part of the preconditioner: one chain of points, closed, in double precision (its springs may be a
// thousand times stiffer than the cells').
#pragma once

#include <span>

#include "kernels/aligned_buffer.hpp"
#include "kernels/kernels.hpp"
#include "suture/physics/term.hpp"

namespace suture {

/// One 2 x 2 block of the extra terms' Hessian.
struct PointBlock {
  int i, j;
  Block block;
};

class RingFactors {
 public:
  RingFactors() = default;
  /// Points first .. first + size - 1 of the position vectors; size is at least 3.
  RingFactors(int first, int size);

  /// Factors I + gamma H of the blocks between its points.
  void set_up(double gamma, std::span<const PointBlock> blocks, const kernels::Table& kernel);
  /// z = P^-1 r on its points.
  void apply(std::span<const double> r, std::span<double> z, const kernels::Table& kernel) const;

 private:
  int first_ = 0, size_ = 0;
  AlignedBuffer buffer_;
  kernels::CyclicBatch matrix_;
  double* rhs_ = nullptr;
};

}  // namespace suture
