// Failures that several terms report in the same words. Private to the library.
#pragma once

#include "suture/geometry/point.hpp"
#include "suture/model/state.hpp"

namespace suture {

inline Point point_at(const StateView& state, int i) { return {state.x[i], state.y[i]}; }

/// Throws NumericalError naming the cell and vertex where a segment of length zero starts.
[[noreturn]] void fail_zero_length(const Tissue& tissue, int segment);

/// Throws NumericalError naming the vertex and what it coincides with: a force there has no direction.
[[noreturn]] void fail_zero_distance(const Tissue& tissue, int vertex, int other);

/// Every segment has a direction; throws otherwise.
void require_nonzero_segments(const Tissue& tissue, const StateView& state);

}  // namespace suture
