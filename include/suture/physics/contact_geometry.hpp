// Which features of a closed chain a point sees: the inclusion-exclusion sum that makes membranes smooth.
//
// A boundary is the union of rectangles along its segments and wedges around its vertices. The rectangles overlap at a
// concave vertex; the vertex term with weight -1 takes the doubled part away. For any function u of a distance
//
//     U(P, chain) = sum_k [0 < t_k < 1] u(|P - foot_k|) + sum_k c_k u(|P - Q_k|),   c_k = 1 - [t_{k-1} < 1] - [t_k > 0]
//
// is exact for convex and concave corners, on either side, without any angle. When P passes the end of a segment, that
// segment's term is exchanged for the vertex term at equal distance and equal gradient: U is C1 along any path and its
// second derivative jumps. Source: model.md section 3; Ton et al. 2023, supplement section II.
#pragma once

#include <span>

#include "suture/geometry/point_segment.hpp"

namespace suture {

/// Calls on_segment(k, t) for every segment k (from vertex k to k + 1) that sees p at the interior fraction t, and
/// on_vertex(k, c) for every vertex with c = +1 (wedge) or c = -1 (seen by both neighbours).
/// x, y: vertices of the closed chain; no two successive ones may coincide.
/// One classification of every segment decides both of its ends, so rounding cannot count a feature twice.
template <class OnSegment, class OnVertex>
void for_each_contact_feature(Point p, std::span<const double> x, std::span<const double> y, OnSegment&& on_segment,
                              OnVertex&& on_vertex) {
  const int count = static_cast<int>(x.size());
  ClosestFeature previous = project(p, {x[count - 1], y[count - 1]}, {x[0], y[0]}).feature;
  for (int k = 0; k < count; ++k) {
    const int next = k + 1 == count ? 0 : k + 1;
    const Projection here = project(p, {x[k], y[k]}, {x[next], y[next]});
    const int weight = (previous == ClosestFeature::end ? 1 : 0) + (here.feature == ClosestFeature::start ? 1 : 0) - 1;
    if (weight != 0) on_vertex(k, weight);
    if (here.feature == ClosestFeature::interior) on_segment(k, here.t);
    previous = here.feature;
  }
}

}  // namespace suture
