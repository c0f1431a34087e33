// The wound: the hole of the tissue, its area and its ordered edge, followed in time (model.md section 7).
//
// Let H be the tracked hole of FreeBoundary, the places the centre of a probe of radius rho = s(1 + l2)/2 can reach.
// The wound is H grown back by delta = rho - s/2: the free space beyond half a membrane (the published convention),
// without the cracks narrower than s(1 + l2). H has a boundary whose inward curvature is at most 1/rho < 1/delta, so
// Steiner's formula gives area(H) + delta length(H) + pi delta^2 (1 - islands) and length(H) + 2 pi delta (1 -
// islands): continuous, without computing the grown outline. Where two corners of H face each other closer than 2 delta
// (= 0.3 s by default) their overlap, at most pi delta^2, is counted twice. A closing wound has area pi delta^2 (0.0012
// for the default membrane) just before it vanishes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "suture/measure/free_boundary.hpp"

namespace suture {

struct Wound {
  double area = 0.0;       ///< units of a0
  double perimeter = 0.0;  ///< of the hole and of the islands in it
  Polygon outline;         ///< counter-clockwise about the wound, s/2 from the membranes; arcs as chords
  Point centre;            ///< centre of area of the outline
  /// Exposed vertices in order, counter-clockwise about the wound, each once. Cells are numbered counter-clockwise
  /// about themselves, so the vertices of one cell appear in DEcreasing order (modulo the cell's first vertex).
  std::vector<int> boundary;
  int parts = 1;               ///< holes that overlap the previous wound; > 1: it has split, this is one part
  double area_of_parts = 0.0;  ///< of all of them
};

template <class Archive>
void exchange_fields(Archive& archive, Wound& w) {
  archive(w.area, w.perimeter, w.outline, w.centre, w.boundary, w.parts, w.area_of_parts);
}

/// The wound among the loops of an evaluated boundary. Without `previous` it is the largest hole; with it, the hole
/// that overlaps the previous outline most. Empty when there is no such hole.
std::optional<Wound> find_wound(const FreeBoundary& boundary, const Wound* previous = nullptr);

/// One-off form, for a single configuration.
std::optional<Wound> find_wound(const Tissue& tissue, const StateView& state, const Membrane& membrane);

enum class WoundStatus {
  absent,  ///< never seen a hole
  open,
  closed,           ///< was open, and its place is now covered by the tissue
  open_to_outside,  ///< was open, and has broken through the rim of the tissue
};

/// Follows the wound through a run. About 350 us per update for 45 cells of 30 vertices.
class WoundTracker {
 public:
  /// rule: which vertices Wound::boundary lists.
  explicit WoundTracker(const Membrane& membrane, ExposureRule rule = ExposureRule::probe_disc);
  /// Measures this configuration and makes it the previous one. Throws NumericalError as FreeBoundary does.
  const std::optional<Wound>& update(const Tissue& tissue, const StateView& state);
  /// The two halves of update(), as those of FreeBoundary::evaluate.
  const Exposure& expose(const Tissue& tissue, const StateView& state, const std::optional<BoundingBox>& within = {});
  const std::optional<Wound>& update_exposed(const Tissue& tissue, const StateView& state);

  /// Makes this the previous configuration's wound.
  void follow(Wound wound) { wound_ = std::move(wound), status_ = WoundStatus::open; }

  const std::optional<Wound>& wound() const { return wound_; }
  WoundStatus status() const { return status_; }
  int splits() const { return splits_; }  ///< updates at which the wound had fallen into several parts
  const FreeBoundary& boundary() const { return boundary_; }
  /// Gives back the memory of the last update(); boundary() is empty until the next.
  void release_memory() { boundary_ = FreeBoundary(boundary_.membrane()); }

  /// What the next update() depends on, for checkpoints (byte_archive.hpp).
  template <class Archive>
  void fields(Archive& archive) {
    archive(wound_, status_, splits_);
  }

 private:
  FreeBoundary boundary_;
  std::optional<ExposureMeasure> strict_;
  std::optional<Wound> wound_;
  WoundStatus status_ = WoundStatus::absent;
  int splits_ = 0;
};

/// Areas of all holes, as Wound::area, largest first.
std::vector<double> hole_areas(const FreeBoundary& boundary);

}  // namespace suture
