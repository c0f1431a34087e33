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
struct VectorFamily {
  explicit VectorFamily(WorkerPool& workers = WorkerPool::alone()) : operations(workers) {}
  std::vector<N_Vector> members;
  VectorOperations operations;
  /// Every member becomes new[k] = old[source[k]].
  void rearrange(std::span<const int> source);
};

/// A new vector of n zeros; freed by N_VDestroy.
N_Vector make_fused_vector(std::size_t n, SUNContext context, std::shared_ptr<VectorFamily> family);

/// The values of a fused vector (or of any clone of one).
std::span<double> values(N_Vector v);

}  // namespace suture
