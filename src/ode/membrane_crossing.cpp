#include "ode/membrane_crossing.hpp"

#include <algorithm>

#include "suture/geometry/point.hpp"

namespace suture {

namespace {

struct Positions {
  std::span<const double> q;
  Point operator[](int v) const { return {q[v], q[q.size() / 2 + v]}; }
};

/// Even-odd rule.
bool inside(const Tissue& tissue, int cell, const Positions& at, int vertex) {
  const Point p = at[vertex];
  bool odd = false;
  Point a = at[tissue.end_vertex(cell) - 1];
  for (int v = tissue.first_vertex(cell); v < tissue.end_vertex(cell); ++v) {
    const Point b = at[v];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
    a = b;
  }
  return odd;
}

/// Whether p is on the inner side of the place of a counter-clockwise chain that is nearest to it. The ends of the chain are in
/// the middle of another, or far.
bool on_inner_side(std::span<const Point> chain, Point p) {
  double least = 1e300;
  bool inner = false;
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    const Point edge = chain[k + 1] - chain[k], from = p - chain[k];
    const double t = dot(edge, from) / dot(edge, edge), within = std::clamp(t, 0.0, 1.0);
    const Point off = from - within * edge;
    if (!(dot(off, off) < least)) continue;
    least = dot(off, off);
    if (t > 0.0 && t < 1.0)
      inner = cross(edge, from) > 0.0;
    else if (const std::size_t corner = t <= 0.0 ? k : k + 1; corner > 0 && corner + 1 < chain.size())
      inner = cross(chain[corner] - chain[corner - 1], chain[corner + 1] - chain[corner]) < 0.0;
    else
      inner = false;
  }
  return inner;
}

}  // namespace

int vertex_through_membrane(const Tissue& tissue, const PaddedTissue& padded, const ContactList& list, std::span<const double> before,
                            std::span<const double> after) {
  const Positions then{before}, now{after};
  Point chain[kernels::window_segments + 1];
  for (int k = 0; k < list.schedule().lists(); ++k) {
    const kernels::WindowGroup* const groups = list.entries(k).groups.data();
    for (std::size_t i = 0; i < list.active(k); ++i) {
      const kernels::WindowGroup& group = groups[i / kernels::WindowGroup::windows];
      const std::size_t lane = i % kernels::WindowGroup::windows;
      const auto [p, q] = group.slots[lane];
      std::size_t points = 1;
      chain[0] = now[padded.vertex(q)];
      for (const std::uint64_t has : group.segments)
        if (has >> lane & 1u) chain[points] = now[padded.vertex(q + static_cast<int>(points))], ++points;
      const int vertex = padded.vertex(p), cell = tissue.cell_of(padded.vertex(q));
      if (on_inner_side({chain, points}, now[vertex]) && inside(tissue, cell, now, vertex) && !inside(tissue, cell, then, vertex)) return vertex;
    }
  }
  return -1;
}

}  // namespace suture
