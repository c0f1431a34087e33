// Second derivative of a function of the distance between two points. Private to the library.
#pragma once

#include "suture/geometry/point.hpp"
#include "suture/physics/term.hpp"

namespace suture {

/// d2f/dr2 of f(|r|): `second` along the unit vector r/|r| = n, `first`/|r| across it.
inline Block radial_block(Point n, double distance, double first, double second) {
  const double across = first / distance, along = second - across;
  return {along * n.x * n.x + across, along * n.x * n.y, along * n.x * n.y, along * n.y * n.y + across};
}

/// Adds f(|r_i - r_j|), whose second derivative with respect to r_i is `block`.
inline void add_pair(HessianSink& sink, int i, int j, const Block& block) {
  sink.add_block(i, i, block);
  sink.add_block(j, j, block);
  sink.add_block(i, j, {-block[0], -block[1], -block[2], -block[3]});
}

}  // namespace suture
