// Our own N_Vector: zero-padded, cache-aligned storage and fused, vectorised operations. Debian's N_Vector_Serial costs
// more than the physics at a few thousand unknowns (shared/design.md section 2).
#pragma once

#include <sundials/sundials_nvector.h>

#include <span>

namespace suture {

/// A new vector of n zeros; freed by N_VDestroy.
N_Vector make_fused_vector(std::size_t n, SUNContext context);

/// The values of a fused vector (or of any clone of one).
std::span<double> values(N_Vector v);

}  // namespace suture
