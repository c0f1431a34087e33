#include "suture/physics/confinement.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "physics/numerical_failure.hpp"
#include "physics/pair_hessian.hpp"
#include "suture/errors.hpp"

namespace suture {

/// Calls visit(vertex, unit vector outwards, r, 1 - (R - r)/sigma) for every vertex the wall acts on.
template <class Visit>
void Confinement::for_each_pressed(const StateView& state, Visit&& visit) const {
  const double free_radius = std::max(radius_ - range_, 0.0);
  for (int v = 0; v < vertices_; ++v) {
    const Point arm = point_at(state, v) - Point{center_x_, center_y_};
    if (squared_norm(arm) < free_radius * free_radius) continue;
    const double r = norm(arm), depth = 1.0 - (radius_ - r) / range_;
    if (!(depth > 0.0)) continue;
    if (r == 0.0)
      throw NumericalError(fmt::format("point {} lies exactly at the centre of a wall smaller than its range", v));
    visit(v, (1.0 / r) * arm, r, depth);
  }
}

Confinement::Confinement(double center_x, double center_y, double radius, double range, double energy, int vertices)
    : center_x_(center_x), center_y_(center_y), radius_(radius), range_(range), energy_(energy), vertices_(vertices) {
  if (!(radius > 0.0)) throw InputError(fmt::format("the radius of the wall is {}; it must be positive", radius));
  if (!(range > 0.0)) throw InputError(fmt::format("the range of the wall is {}; it must be positive", range));
  if (!(energy >= 0.0)) throw InputError(fmt::format("the energy of the wall is {}; it must not be negative", energy));
}

double Confinement::energy(double, const StateView& state) const {
  double sum = 0.0;
  for_each_pressed(state, [&](int, Point, double, double depth) { sum += energy_ * depth * depth; });
  return sum;
}

void Confinement::add_gradient(double, const StateView& state, MutableStateView gradient) const {
  for_each_pressed(state, [&](int v, Point outwards, double, double depth) {
    const double slope = 2.0 * energy_ * depth / range_;
    gradient.x[v] += slope * outwards.x;
    gradient.y[v] += slope * outwards.y;
  });
}

void Confinement::add_hessian(double, const StateView& state, HessianSink& sink) const {
  for_each_pressed(state, [&](int v, Point outwards, double r, double depth) {
    sink.add_block(v, v, radial_block(outwards, r, 2.0 * energy_ * depth / range_, 2.0 * energy_ / (range_ * range_)));
  });
}

}  // namespace suture
