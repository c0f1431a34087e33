// The padded arrays of kernels.hpp for one tissue, and the copies between them and contiguous vertex arrays. A large tissue is
// divided into blocks of consecutive cells that several threads may work on: no slot is touched from two of them.
#pragma once

#include <span>
#include <vector>

#include "kernels/aligned_buffer.hpp"
#include "kernels/kernels.hpp"
#include "suture/model/tissue.hpp"
#include "threads/ranges.hpp"

namespace suture {

class PaddedTissue {
 public:
  /// cells_per_block: 0 for one block.
  PaddedTissue(const Tissue& tissue, SpringLaw law, int cells_per_block = 0);

  kernels::Shell shell;
  kernels::ShellHessian hessian;

  int cells() const { return shell.cells; }
  int slots() const { return slots_; }
  int slot(int vertex) const { return slot_of_[vertex]; }
  int vertex(int slot) const { return vertex_of_[slot]; }

  int blocks() const { return blocks_.count(); }
  Range cells_of(int block) const { return blocks_[block]; }
  Range vertices_of(int block) const;
  /// The part of `shell`, `hessian` that belongs to one block.
  kernels::Shell shell_of(int block) const;
  kernels::ShellHessian hessian_of(int block) const;

  // Copies, of one block (`values` are the whole tissue's) or of everything.
  void unpack(std::span<const double> values, double* padded, int block) const;
  void fold_and_pack(double* padded, std::span<double> values, int block) const;
  void pack_gradient(std::span<double> gx, std::span<double> gy, int block = 0) const;
  /// What repeats the vertices of one cell.
  void repeat_ends(double* padded, int cell) const {
    double* a = padded + base_[cell];
    const int n = count_[cell];
    a[0] = a[n];
    for (int k = 1; k < kernels::halo; ++k) a[n + k] = a[k];
  }
  /// padded <- contiguous, halo included.
  void unpack(std::span<const double> values, double* padded) const;
  /// Folds the halo of an accumulated array onto its vertices, then packs.
  void fold_and_pack(double* padded, std::span<double> values) const;

 private:
  void take_arrays(const Tissue& tissue);

  int slots_ = 0;
  Ranges blocks_;
  std::vector<int> base_, count_, slot_of_, vertex_of_;
  std::vector<double> rest_area_, area_stiffness_, bending_stiffness_, area_, pressure_, area_curvature_;
  AlignedBuffer buffer_;
};

}  // namespace suture
