#include "suture/physics/contact.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "physics/numerical_failure.hpp"
#include "physics/pair_hessian.hpp"
#include "suture/physics/contact_geometry.hpp"

namespace suture {

namespace {

struct Box {
  double left, right, bottom, top;
  bool contains(Point p) const { return p.x >= left && p.x <= right && p.y >= bottom && p.y <= top; }
  bool meets(const Box& other) const {
    return left <= other.right && other.left <= right && bottom <= other.top && other.bottom <= top;
  }
};

/// Bounding box of every cell, widened by `margin` on each side.
std::vector<Box> widened_boxes(const Tissue& tissue, const StateView& state, double margin) {
  std::vector<Box> boxes;
  for (int cell = 0; cell < tissue.cell_count(); ++cell) {
    const int first = tissue.first_vertex(cell), end = tissue.end_vertex(cell);
    const auto [left, right] = std::minmax_element(state.x.begin() + first, state.x.begin() + end);
    const auto [bottom, top] = std::minmax_element(state.y.begin() + first, state.y.begin() + end);
    boxes.push_back({*left - margin, *right + margin, *bottom - margin, *top + margin});
  }
  return boxes;
}

/// Calls visit(vertex, cell) for every vertex and other cell that may be within reach.
template <class Visit>
void for_each_candidate(const Tissue& tissue, const StateView& state, double reach, PairSearch search, Visit&& visit) {
  const double margin = search == PairSearch::all_pairs ? std::numeric_limits<double>::infinity() : reach;
  const std::vector<Box> boxes = widened_boxes(tissue, state, margin);
  for (int own = 0; own < tissue.cell_count(); ++own)
    for (int other = 0; other < tissue.cell_count(); ++other) {
      if (own == other || !boxes[own].meets(boxes[other])) continue;
      for (int v = tissue.first_vertex(own); v < tissue.end_vertex(own); ++v)
        if (boxes[other].contains(point_at(state, v))) visit(v, other);
    }
}

/// A vertex P above the interior of a segment AB.
struct SegmentContact {
  std::array<int, 3> vertex;     ///< P, A, B
  std::array<double, 3> weight;  ///< 1, -(1 - t), -t: P minus the foot
  Point normal, tangent;         ///< unit vectors: foot to P, A to B
  double distance, length;
};

/// A vertex P and a vertex Q that it sees with weight +1 or -1.
struct VertexContact {
  int vertex, other;
  double weight;
  Point normal;  ///< unit vector from Q to P
  double distance;
};

/// Calls on_segment(SegmentContact) and on_vertex(VertexContact) for everything closer than `reach`.
template <class OnSegment, class OnVertex>
void for_each_contact(const Tissue& tissue, const StateView& state, double reach, PairSearch search,
                      OnSegment&& on_segment, OnVertex&& on_vertex) {
  require_nonzero_segments(tissue, state);
  for_each_candidate(tissue, state, reach, search, [&](int vertex, int cell) {
    const int first = tissue.first_vertex(cell), count = tissue.vertex_count(cell);
    const Point p = point_at(state, vertex);
    const auto at_segment = [&](int k, double t) {
      const int start = first + k, end = tissue.next(start);
      const Point a = point_at(state, start), edge = point_at(state, end) - a;
      const double length = norm(edge), height = cross(edge, p - a) / length;  // signed: positive on the left
      const double distance = std::abs(height);
      if (distance >= reach) return;
      if (distance == 0.0) fail_zero_distance(tissue, vertex, start);
      const Point tangent = (1.0 / length) * edge;
      on_segment(SegmentContact{{vertex, start, end},
                                {1.0, t - 1.0, -t},
                                (height > 0.0 ? 1.0 : -1.0) * left_normal(tangent),
                                tangent,
                                distance,
                                length});
    };
    const auto at_vertex = [&](int k, int weight) {
      const Point separation = p - point_at(state, first + k);
      const double distance = norm(separation);
      if (distance >= reach) return;
      if (distance == 0.0) fail_zero_distance(tissue, vertex, first + k);
      on_vertex(VertexContact{vertex, first + k, static_cast<double>(weight), (1.0 / distance) * separation, distance});
    };
    for_each_contact_feature(p, state.x.subspan(first, count), state.y.subspan(first, count), at_segment, at_vertex);
  });
}

/// Second derivative of u(distance to a segment). With alpha = n.(w dx), gamma = tau.(w dx) and beta = n.(dB - dA),
///     d2u = u'' alpha^2 - u' [ (d/L^2) beta^2 + (2/L) beta gamma ],
/// because the segment turns by beta/L while the foot slides along it by (L gamma + d beta)/L^2.
void add_segment_hessian(const SegmentContact& c, double first, double second, HessianSink& sink) {
  constexpr std::array<double, 3> turn{0.0, -1.0, 1.0};  // beta's coefficients on P, A, B
  const Point n = c.normal, tau = c.tangent;
  for (int p = 0; p < 3; ++p)
    for (int q = p; q < 3; ++q) {
      const double nn =
          second * c.weight[p] * c.weight[q] - first * c.distance / (c.length * c.length) * turn[p] * turn[q];
      const double nt = -first / c.length * turn[p] * c.weight[q], tn = -first / c.length * c.weight[p] * turn[q];
      sink.add_block(
          c.vertex[p], c.vertex[q],
          {nn * n.x * n.x + nt * n.x * tau.x + tn * tau.x * n.x, nn * n.x * n.y + nt * n.x * tau.y + tn * tau.x * n.y,
           nn * n.y * n.x + nt * n.y * tau.x + tn * tau.y * n.x, nn * n.y * n.y + nt * n.y * tau.y + tn * tau.y * n.y});
    }
}

}  // namespace

Contact::Contact(const Tissue& tissue, const ContactParameters& parameters, PairSearch search)
    : tissue_(tissue), law_(make_contact_law(tissue, parameters)), search_(search) {}

double Contact::energy(double, const StateView& state) const {
  double sum = 0.0;
  for_each_contact(
      tissue_, state, law_.reach(), search_, [&](const SegmentContact& c) { sum += law_.value(c.distance); },
      [&](const VertexContact& c) { sum += c.weight * law_.value(c.distance); });
  return sum;
}

void Contact::add_gradient(double, const StateView& state, MutableStateView gradient) const {
  const auto add = [&](int vertex, double factor, Point direction) {
    gradient.x[vertex] += factor * direction.x;
    gradient.y[vertex] += factor * direction.y;
  };
  for_each_contact(
      tissue_, state, law_.reach(), search_,
      [&](const SegmentContact& c) {
        const double slope = law_.first_derivative(c.distance);
        for (int k = 0; k < 3; ++k) add(c.vertex[k], slope * c.weight[k], c.normal);
      },
      [&](const VertexContact& c) {
        const double slope = c.weight * law_.first_derivative(c.distance);
        add(c.vertex, slope, c.normal);
        add(c.other, -slope, c.normal);
      });
}

void Contact::add_hessian(double, const StateView& state, HessianSink& sink) const {
  for_each_contact(
      tissue_, state, law_.reach(), search_,
      [&](const SegmentContact& c) {
        add_segment_hessian(c, law_.first_derivative(c.distance), law_.second_derivative(c.distance), sink);
      },
      [&](const VertexContact& c) {
        add_pair(sink, c.vertex, c.other,
                 radial_block(c.normal, c.distance, c.weight * law_.first_derivative(c.distance),
                              c.weight * law_.second_derivative(c.distance)));
      });
}

}  // namespace suture
