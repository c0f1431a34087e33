// Structured preconditioner of I + gamma H: each cell's membrane, bending, area and the diagonal part of its contacts,
// and the purse string's chain, are factored exactly; only the coupling between them is left to conjugate gradients.
// Sixteen cells of similar size are worked on side by side, one per vector lane.
#pragma once

#include <span>
#include <vector>

#include "ode/cell_batch.hpp"
#include "ode/contact_factors.hpp"
#include "ode/padded_tissue.hpp"
#include "ode/ring_factors.hpp"

namespace suture {

class CellPreconditioner {
 public:
  /// ring_size: 0 or at least 3. Takes its memory, 97 bytes per vertex, at the first set_up(): explicit methods never do.
  CellPreconditioner(const Tissue& tissue, const PaddedTissue& padded, int ring_size, const kernels::Table& kernel);

  void set_ring_size(int ring_size);

  /// Factors at the linearisation held by `padded`, the contact factors and the extra terms' blocks.
  void set_up(double gamma, const ContactFactors& contacts, std::span<const PointBlock> extra, WorkerPool& workers);
  /// z = P^-1 r to single precision, on contiguous position vectors (all x, then all y). r and z may not alias.
  void apply(std::span<const double> r, std::span<double> z, WorkerPool& workers);

 private:
  void make_batches();
  /// (xx, xy, yy, unused) per slot, in the room where `padded` keeps the vectors of a product.
  double* diagonal() const;
  /// Contacts' and extra terms' blocks on the diagonal.
  void sum_diagonal(const ContactFactors& contacts, std::span<const PointBlock> extra, WorkerPool& workers);
  /// task(batch, room), several at once; batches of one range share a room, one behind the other.
  template <class Task>
  void for_each_batch(WorkerPool& workers, const Task& task);

  const Tissue* tissue_;
  const PaddedTissue* padded_;
  const kernels::Table* kernel_;
  int ring_size_;
  RingFactors ring_;
  std::vector<CellBatch> batches_;
  Ranges ranges_;                  ///< of batches
  std::vector<FactorRoom> rooms_;  ///< one per range
};

}  // namespace suture
