// The wound as seen from the cells around it: the same result as the whole tissue gives, at the cost of the part that
// matters. What watches a closure asks thousands of times for an edge that a dozen cells make up.
#pragma once

#include <optional>
#include <vector>

#include "suture/measure/exposure.hpp"
#include "suture/measure/wound.hpp"

namespace suture {

struct MembraneSegment;

/// Only a box around a former outline of the wound is looked at, and for what covers membranes there the cells that come
/// into it or within a probe's diameter of it. When the wound is not found there, its outline has come within half of that distance of the edge of the box, or another
/// boundary that leaves the box has come to the former wound, the whole tissue is: a wound may move any distance between two updates.
/// Results are those of WoundTracker on the whole tissue, bit for bit unless that needs a larger probe (free_boundary.cpp).
class WoundNeighbourhood {
 public:
  /// margin: how far the box goes beyond the outline, model units of length; by default a third of the diameter of a cell.
  explicit WoundNeighbourhood(const Membrane& membrane, double margin = 0.4);

  /// As WoundTracker::update, vertices numbered as in `tissue`. Throws NumericalError as FreeBoundary does.
  const std::optional<Wound>& update(const Tissue& tissue, const StateView& state);
  /// One flag per vertex of `tissue`, by probe_disc; zero for those outside the box. Of cells that are not looked at positions are
  /// not read.
  /// Valid until the next call.
  const std::vector<char>& exposed(const Tissue& tissue, const StateView& state);
  /// If the last update() had to look at the whole tissue: from now on only around the wound that it found.
  void look_around_wound(const Tissue& tissue, const StateView& state);
  /// Whether it is certain, without a new look, that exposed() would show nobody who was not exposed at the last look: what was found to
  /// cover the others then, or what is beside it, covers them still. Reads the same positions.
  bool surely_uncovers_nobody(const Tissue& tissue, const StateView& state);
  /// What exposed() would have given for the state of the last update(), which has found it on its way.
  const std::vector<char>& exposed_at_update() const { return exposed_; }
  const std::optional<Wound>& wound() const { return wound_; }
  WoundStatus status() const { return tracker_.status(); }
  /// Cells that were looked at; empty: all.
  const std::vector<int>& cells() const { return cells_; }
  /// For checkpoints (byte_archive.hpp); what is made when it is needed is made again.
  template <class Archive>
  void fields(Archive& archive) {
    archive(tracker_, cells_, wound_, region_.x_low, region_.x_high, region_.y_low, region_.y_high);
    if constexpr (Archive::reading) forget_part();
  }

 private:
  void choose_region(const Wound& former);
  void choose_cells(const Tissue& tissue, const StateView& state);
  void look_at_all();
  void forget_part() { part_.reset(), is_exposed_ = false; }
  void look(const Tissue& tissue, const StateView& state);
  /// The part of the tissue that is looked at, and its positions.
  const Tissue& part(const Tissue& tissue);
  StateView gather(const StateView& state);
  /// Exposure of the part at these positions, in the tracker.
  const Exposure& expose(const Tissue& watched, const StateView& positions);
  /// From one flag per vertex of the part to one per vertex of the tissue, in exposed_.
  const std::vector<char>& scatter(const Tissue& tissue, const std::vector<char>& found);

  MembraneSegment segment(const Tissue& watched, int v) const;
  bool far_along_membrane(const Tissue& watched, int v, int s, double distance) const;
  bool surely_covered(const Tissue& watched, int v, const MembraneSegment& before, const MembraneSegment& after, int blocker) const;

  double margin_;
  WoundTracker tracker_;
  BoundingBox region_{};             // that is looked at, while cells_ is not empty
  std::vector<int> cells_, chosen_;  // that come into it, empty: all; the next ones
  std::optional<Tissue> part_;  // made of them when it is needed
  std::vector<int> vertex_;     // of the tissue, one per vertex of part_
  std::vector<double> x_, y_;
  bool is_exposed_ = false;     // the tracker has the exposure of part_ at (x_, y_) in region_, bit for bit
  std::optional<Wound> wound_;
  std::vector<char> exposed_;
};

}  // namespace suture
