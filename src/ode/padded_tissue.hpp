// The padded arrays of kernels.hpp for one tissue, and the copies between them and contiguous vertex arrays.
#pragma once

#include <span>
#include <vector>

#include "kernels/aligned_buffer.hpp"
#include "kernels/kernels.hpp"
#include "suture/model/tissue.hpp"

namespace suture {

class PaddedTissue {
 public:
  PaddedTissue(const Tissue& tissue, SpringLaw law);

  kernels::Shell shell;
  kernels::ShellHessian hessian;

  int cells() const { return shell.cells; }
  int slots() const { return slots_; }
  int slot(int vertex) const { return slot_of_[vertex]; }
  int vertex(int slot) const { return vertex_of_[slot]; }

  /// padded <- contiguous, halo included.
  void unpack(std::span<const double> values, double* padded) const;
  /// contiguous <- padded, halo ignored.
  void pack(const double* padded, std::span<double> values) const;
  /// Folds the halo of an accumulated array onto its vertices, then packs.
  void fold_and_pack(double* padded, std::span<double> values) const;

 private:
  int slots_ = 0;
  std::vector<int> base_, count_, slot_of_, vertex_of_;
  std::vector<double> rest_area_, area_stiffness_, bending_stiffness_, area_, pressure_, area_curvature_;
  AlignedBuffer buffer_;
};

}  // namespace suture
