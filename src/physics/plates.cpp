#include "suture/physics/plates.hpp"

#include <fmt/format.h>

#include "suture/errors.hpp"

namespace suture {

namespace {

/// Calls visit(vertex, +1 for the top or -1 for the bottom plate, 1 - q/sigma) for every plate that acts on a vertex.
template <class Visit>
void for_each_pressed(const ParallelPlates& plates, double t, int vertices, const StateView& state, Visit&& visit) {
  const double half_gap = 0.5 * plates.gap_at(t);
  for (int v = 0; v < vertices; ++v)
    for (const double side : {1.0, -1.0}) {
      const double depth = 1.0 - (half_gap - side * (state.y[v] - plates.center_y)) / plates.range;
      if (depth > 0.0) visit(v, side, depth);
    }
}

}  // namespace

Plates::Plates(const ParallelPlates& plates, int vertices) : plates_(plates), vertices_(vertices) {
  if (!(plates.gap > 0.0))
    throw InputError(fmt::format("the gap between the plates is {}; it must be positive", plates.gap));
  if (!(plates.range > 0.0))
    throw InputError(fmt::format("the range of the plates is {}; it must be positive", plates.range));
  if (!(plates.energy >= 0.0))
    throw InputError(fmt::format("the energy of the plates is {}; it must not be negative", plates.energy));
}

double Plates::energy(double t, const StateView& state) const {
  double sum = 0.0;
  for_each_pressed(plates_, t, vertices_, state,
                   [&](int, double, double depth) { sum += plates_.energy * depth * depth; });
  return sum;
}

void Plates::add_gradient(double t, const StateView& state, MutableStateView gradient) const {
  for_each_pressed(plates_, t, vertices_, state, [&](int v, double side, double depth) {
    gradient.y[v] += side * 2.0 * plates_.energy * depth / plates_.range;
  });
}

void Plates::add_hessian(double t, const StateView& state, HessianSink& sink) const {
  const double stiffness = 2.0 * plates_.energy / (plates_.range * plates_.range);
  for_each_pressed(plates_, t, vertices_, state, [&](int v, double, double) {
    sink.add_block(v, v, {0.0, 0.0, 0.0, stiffness});
  });
}

}  // namespace suture
