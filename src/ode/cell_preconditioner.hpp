// Structured preconditioner of I + gamma H: each cell's membrane, bending, area and the diagonal part of its contacts,
// and the purse string's chain, are factored exactly; only the coupling between them is left to conjugate gradients.
// Eight cells of similar size are factored side by side, one per vector lane.
#pragma once

#include <span>
#include <vector>

#include "ode/contact_factors.hpp"
#include "ode/padded_tissue.hpp"
#include "suture/model/state.hpp"
#include "suture/physics/term.hpp"

namespace suture {

/// One 2 x 2 block of the extra terms' Hessian.
struct PointBlock {
  int i, j;
  Block block;
};

class CellPreconditioner {
 public:
  /// ring_size: 0 or at least 3. Takes its memory, 260 bytes per vertex, at the first set_up(): explicit methods never do.
  CellPreconditioner(const Tissue& tissue, const PaddedTissue& padded, int ring_size, const kernels::Table& kernel);

  void set_ring_size(int ring_size);

  /// Factors at the linearisation held by `padded`, the contact factors and the extra terms' blocks.
  void set_up(double gamma, const ContactFactors& contacts, std::span<const PointBlock> extra, WorkerPool& workers);
  /// z = P^-1 r, on contiguous position vectors (all x, then all y). r and z may not alias.
  void apply(std::span<const double> r, std::span<double> z, WorkerPool& workers);

 private:
  struct Batch {
    kernels::CyclicBatch matrix;
    int lanes = 1;                 ///< 8 for cells, 1 for the ring
    std::vector<int> cell;         ///< of each lane in use
    std::vector<int> lead;         ///< identity rows before the cell's first vertex
    double* area_solution = nullptr;  ///< M^-1 g
    double* area_gradient = nullptr;  ///< g = da/dr
    double* rhs = nullptr;
    std::vector<double> gain;      ///< Sherman-Morrison factor of each lane
  };
  void make_batches();
  void allocate(Batch& batch);
  void allocate_scratch();
  static void make_identity(Batch& batch);
  /// Adds a block at (row, column) of one lane.
  static void add(Batch& batch, int lane, int row, int column, double xx, double xy, double yx, double yy);
  /// Contacts' and extra terms' blocks on the diagonal, per slot.
  void sum_diagonal(const ContactFactors& contacts, std::span<const PointBlock> extra, WorkerPool& workers);
  /// Copies what the batch's cells are made of into lane order.
  void gather(Batch& batch, kernels::CellRows& rows);
  void close_ring(Batch& batch, int lane, double gamma);
  void set_up_cells(Batch& batch, kernels::CellRows& rows, double gamma);
  void set_up_ring(Batch& batch, double gamma, std::span<const PointBlock> extra);
  void factor_area(Batch& batch, double gamma);
  void apply_ring(Batch& ring, std::span<const double> r, std::span<double> z) const;
  void apply_cells(Batch& batch, std::span<const double> r, std::span<double> z) const;
  /// task(batch, range it belongs to), one range beside the other.
  template <class Task>
  void for_each_batch(WorkerPool& workers, const Task& task);

  const Tissue* tissue_;
  const PaddedTissue* padded_;
  const kernels::Table* kernel_;
  int ring_size_;
  std::vector<Batch> batches_;   ///< cells; the ring, when there is one, is the last
  std::vector<AlignedBuffer> buffers_;
  AlignedBuffer scratch_;
  double* diagonal_ = nullptr;   ///< (xx, xy, yy, unused) per slot
  std::vector<kernels::CellRows> rows_;  ///< per range of batches: of one batch at a time
};

}  // namespace suture
