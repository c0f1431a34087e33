// The boundary of the cells thickened by the probe radius rho = s(1 + l2)/2: where the centre of a probe disc can roll.
//
// It is an arrangement of straight lines (parallel to the segments, rho outside) and arcs of radius rho (about convex
// vertices), computed exactly, without pixels and without polygon clipping: from every line and arc the parts within
// rho of another segment are removed (one interval per segment, because thickened segments are pseudo-discs), and the
// pieces that remain are linked end to start. Each closed loop is either the outer rim of a patch of cells or a hole.
// Cracks narrower than 2 rho are sealed. Everything is continuous in the vertex positions until a loop splits, merges
// or vanishes. Loops are found exactly, so the union-find over neighbours that flood-fill codes need (Newman and Ziff,
// Phys. Rev. E 64, 016706, 2001) is not needed here.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "suture/measure/exposure.hpp"
#include "suture/measure/polygon.hpp"

namespace suture {

/// One closed loop. The cells are on its left: rims run counter-clockwise (positive area), holes clockwise (negative).
struct BoundaryLoop {
  double signed_area = 0.0;   ///< enclosed by the path of the probe's centre
  double length = 0.0;        ///< of that path
  std::vector<int> vertices;  ///< the exposed vertices (probe_disc) the loop passes, in order
  Polygon outline;            ///< the loop moved to s/2 from the membrane, arcs as chords; same direction
  Point inside_probe;         ///< a point of the loop

  bool is_hole() const { return signed_area < 0.0; }
};

/// Reusable workspace. The result is a pure function of (tissue, state); about 250 us for 45 cells of 30 vertices.
class FreeBoundary {
 public:
  explicit FreeBoundary(const Membrane& membrane);
  ~FreeBoundary();
  FreeBoundary(FreeBoundary&&) noexcept;
  FreeBoundary& operator=(FreeBoundary&&) noexcept;

  /// Throws NumericalError for a coordinate that is not finite or a segment without length.
  void evaluate(const Tissue& tissue, const StateView& state);
  /// The two halves of evaluate(): after the first only exposure() is valid; the second is given the same tissue and state.
  /// within: only vertices in this box and the segments between them are looked at. Other vertices count as not exposed, and loops
  /// along other segments are left out; what is found is what would be found without a box.
  void expose(const Tissue& tissue, const StateView& state, const std::optional<BoundingBox>& within = {});
  void trace(const Tissue& tissue, const StateView& state);

  const Membrane& membrane() const;
  /// Valid until the next evaluation, like everything below. Largest enclosed area first.
  std::span<const BoundaryLoop> loops() const;
  const Exposure& exposure() const;  ///< by probe_disc
  /// Whether something of a loop that was left out lies inside this outline or within a probe's radius of it.
  bool left_out_meets(std::span<const Point> outline) const;
  /// Largest distance between an end and the start it was linked to: rounding, about 1e-8, unless cells have been
  /// pushed through each other.
  double largest_gap() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace suture
