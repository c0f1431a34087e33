#include "suture/physics/membrane_elasticity.hpp"

#include <fmt/format.h>

#include "physics/numerical_failure.hpp"
#include "physics/pair_hessian.hpp"
#include "suture/errors.hpp"

namespace suture {

SpringResponse spring_response(SpringLaw law, double stiffness, double length, double rest_length,
                               double initial_rest_length) {
  const double unit = law == SpringLaw::relative ? rest_length : initial_rest_length;
  const double strain = (length - rest_length) / unit;
  return {0.5 * stiffness * strain * strain, stiffness * strain / unit, stiffness / (unit * unit)};
}

struct MembraneElasticity::Spring {
  int next;
  double length;
  Point direction;  ///< unit vector to the next vertex
  SpringResponse response;
};

MembraneElasticity::Spring MembraneElasticity::spring(int segment, const StateView& state) const {
  const int next = tissue_.next(segment);
  const Point edge = point_at(state, next) - point_at(state, segment);
  const double length = norm(edge), rest_length = state.rest_length[segment];
  if (length == 0.0) fail_zero_length(tissue_, segment);
  if (law_ == SpringLaw::relative && rest_length == 0.0)
    throw NumericalError(
        fmt::format("{}: the rest length of the segment to the next vertex is zero", tissue_.vertex_name(segment)));
  return {next, length, (1.0 / length) * edge,
          spring_response(law_, tissue_.material(tissue_.cell_of(segment)).membrane_stiffness, length, rest_length,
                          tissue_.initial_rest_length(segment))};
}

double MembraneElasticity::energy(double, const StateView& state) const {
  double sum = 0.0;
  for (int v = 0; v < tissue_.vertex_count(); ++v) sum += spring(v, state).response.energy;
  return sum;
}

void MembraneElasticity::add_gradient(double, const StateView& state, MutableStateView gradient) const {
  for (int v = 0; v < tissue_.vertex_count(); ++v) {
    const Spring s = spring(v, state);
    const Point pull = s.response.tension * s.direction;
    gradient.x[v] -= pull.x;
    gradient.y[v] -= pull.y;
    gradient.x[s.next] += pull.x;
    gradient.y[s.next] += pull.y;
  }
}

void MembraneElasticity::add_hessian(double, const StateView& state, HessianSink& sink) const {
  for (int v = 0; v < tissue_.vertex_count(); ++v) {
    const Spring s = spring(v, state);
    add_pair(sink, v, s.next, radial_block(s.direction, s.length, s.response.tension, s.response.stiffness));
  }
}

}  // namespace suture
