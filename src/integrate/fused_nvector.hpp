// Our own N_Vector: zero-padded, cache-aligned storage and fused, vectorised operations. Debian's N_Vector_Serial costs
// more than the physics at a few thousand unknowns (shared/design.md section 2).
#pragma once

#include <sundials/sundials_nvector.h>

#include <memory>
#include <span>
#include <vector>

#include "integrate/vector_operations.hpp"

namespace suture {

/// A vector and all its clones, in the order in which they were made. An event that changes the size of the system
/// rearranges all of them at once.
///
/// CVODE predicts and rescales its history by sums of two vectors and multiples of one, up to a dozen in a row. They wait until somebody
/// looks at a member, and are then made piece by piece, which saves most of the passes over memory and changes no bit.
struct VectorFamily {
  explicit VectorFamily(WorkerPool& workers = WorkerPool::alone()) : operations(workers) {}
  std::vector<N_Vector> members;
  VectorOperations operations;
  /// Every member becomes new[k] = old[source[k]].
  void rearrange(std::span<const int> source);
  void add(const LinearSum& sum, std::size_t padded_size);
  /// Makes the sums that wait.
  void settle();

 private:
  static constexpr std::size_t most_waiting = 32;
  std::vector<LinearSum> waiting_;
  std::size_t padded_size_ = 0;
};

/// A new vector of n zeros; freed by N_VDestroy.
N_Vector make_fused_vector(std::size_t n, SUNContext context, std::shared_ptr<VectorFamily> family);

/// The values of a fused vector (or of any clone of one), valid until the next operation on its family.
std::span<double> values(N_Vector v);

}  // namespace suture
