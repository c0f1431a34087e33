#include "suture/physics/bending_elasticity.hpp"

#include <array>
#include <cmath>

#include "physics/numerical_failure.hpp"

namespace suture {

namespace {

struct Corner {
  std::array<int, 3> vertex;  ///< previous, this, next
  Point incoming, outgoing;   ///< the two edges
  double angle;
};

Corner corner(const Tissue& tissue, int vertex, const StateView& state) {
  const int previous = tissue.previous(vertex), next = tissue.next(vertex);
  const Point a = point_at(state, vertex) - point_at(state, previous),
              b = point_at(state, next) - point_at(state, vertex);
  return {{previous, vertex, next}, a, b, std::atan2(cross(a, b), dot(a, b))};
}

/// Gradient of the polar angle of an edge.
Point polar_gradient(Point edge) { return (1.0 / squared_norm(edge)) * left_normal(edge); }

/// Second derivative of the polar angle of an edge, times factor.
Block polar_hessian(Point edge, double factor) {
  const double square = squared_norm(edge), scale = factor / (square * square);
  const double diagonal = 2.0 * scale * edge.x * edge.y, mixed = scale * (edge.y * edge.y - edge.x * edge.x);
  return {diagonal, mixed, mixed, -diagonal};
}

/// d theta / d(previous, this, next).
std::array<Point, 3> angle_gradient(const Corner& c) {
  const Point by_incoming = polar_gradient(c.incoming), by_outgoing = polar_gradient(c.outgoing);
  return {by_incoming, -1.0 * (by_incoming + by_outgoing), by_outgoing};
}

Block sum(const Block& a, const Block& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]}; }

Block outer(double factor, Point a, Point b) {
  return {factor * a.x * b.x, factor * a.x * b.y, factor * a.y * b.x, factor * a.y * b.y};
}

}  // namespace

double BendingElasticity::energy(double, const StateView& state) const {
  require_nonzero_segments(tissue_, state);
  double total = 0.0;
  for (int v = 0; v < tissue_.vertex_count(); ++v) {
    const double angle = corner(tissue_, v, state).angle;
    total += 0.5 * tissue_.material(tissue_.cell_of(v)).bending_stiffness * angle * angle;
  }
  return total;
}

void BendingElasticity::add_gradient(double, const StateView& state, MutableStateView gradient) const {
  require_nonzero_segments(tissue_, state);
  for (int v = 0; v < tissue_.vertex_count(); ++v) {
    const Corner c = corner(tissue_, v, state);
    const double moment = tissue_.material(tissue_.cell_of(v)).bending_stiffness * c.angle;
    const std::array<Point, 3> g = angle_gradient(c);
    for (int k = 0; k < 3; ++k) {
      gradient.x[c.vertex[k]] += moment * g[k].x;
      gradient.y[c.vertex[k]] += moment * g[k].y;
    }
  }
}

void BendingElasticity::add_hessian(double, const StateView& state, HessianSink& sink) const {
  require_nonzero_segments(tissue_, state);
  for (int v = 0; v < tissue_.vertex_count(); ++v) {
    const Corner c = corner(tissue_, v, state);
    const double stiffness = tissue_.material(tissue_.cell_of(v)).bending_stiffness;
    const std::array<Point, 3> g = angle_gradient(c);
    const Block in = polar_hessian(c.incoming, -stiffness * c.angle),
                out = polar_hessian(c.outgoing, stiffness * c.angle);
    const auto [previous, here, next] = c.vertex;
    const auto minus = [](const Block& b) { return Block{-b[0], -b[1], -b[2], -b[3]}; };
    sink.add_block(previous, previous, sum(outer(stiffness, g[0], g[0]), in));
    sink.add_block(here, here, sum(outer(stiffness, g[1], g[1]), sum(in, out)));
    sink.add_block(next, next, sum(outer(stiffness, g[2], g[2]), out));
    sink.add_block(previous, here, sum(outer(stiffness, g[0], g[1]), minus(in)));
    sink.add_block(here, next, sum(outer(stiffness, g[1], g[2]), minus(out)));
    sink.add_block(previous, next, outer(stiffness, g[0], g[2]));
  }
}

}  // namespace suture
