#include "physics/numerical_failure.hpp"

#include <fmt/format.h>

#include "suture/errors.hpp"

namespace suture {

void fail_zero_length(const Tissue& tissue, int segment) {
  throw NumericalError(fmt::format("{}: the segment to the next vertex has length zero, so it has no direction",
                                   tissue.vertex_name(segment)));
}

void fail_zero_distance(const Tissue& tissue, int vertex, int other) {
  throw NumericalError(
      fmt::format("{} lies exactly on {} or on the segment that starts there: the contact force has no direction",
                  tissue.vertex_name(vertex), tissue.vertex_name(other)));
}

void require_nonzero_segments(const Tissue& tissue, const StateView& state) {
  for (int v = 0; v < tissue.vertex_count(); ++v)
    if (squared_norm(point_at(state, tissue.next(v)) - point_at(state, v)) == 0.0) fail_zero_length(tissue, v);
}

}  // namespace suture
