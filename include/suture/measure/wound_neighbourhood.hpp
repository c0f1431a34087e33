// The wound as seen from the cells around it: the same result as the whole tissue gives, at the cost of the part that
// matters. What watches a closure asks thousands of times for an edge that a dozen cells make up.
#pragma once

#include <optional>
#include <vector>

#include "suture/measure/exposure.hpp"
#include "suture/measure/wound.hpp"

namespace suture {

/// Only cells whose bounding box comes within `margin` of the box of the last wound's outline are looked at. When the wound
/// is not found there, or its outline has come within half a margin of the edge of that region, the whole tissue is:
/// a wound may move any distance between two updates. Results are those of WoundTracker and ExposureMeasure on the whole tissue.
class WoundNeighbourhood {
 public:
  /// margin: model units of length; by default a third of the diameter of a cell.
  explicit WoundNeighbourhood(const Membrane& membrane, double margin = 0.4);

  /// As WoundTracker::update, vertices numbered as in `tissue`. Throws NumericalError as FreeBoundary does.
  const std::optional<Wound>& update(const Tissue& tissue, const StateView& state);
  /// One flag per vertex of `tissue`, by probe_disc; zero for cells that are not looked at, whose positions are not read.
  /// Valid until the next call.
  const std::vector<char>& exposed(const Tissue& tissue, const StateView& state);
  /// What exposed() would have given for the state of the last update(), which has found it on its way.
  const std::vector<char>& exposed_at_update() const { return exposed_; }
  const std::optional<Wound>& wound() const { return wound_; }
  WoundStatus status() const { return tracker_.status(); }
  /// Cells that were looked at; empty: all.
  const std::vector<int>& cells() const { return cells_; }
  /// For checkpoints (byte_archive.hpp); what is made when it is needed is made again.
  template <class Archive>
  void fields(Archive& archive) {
    archive(tracker_, cells_, wound_);
    if constexpr (Archive::reading) forget_part();
  }

 private:
  void choose_cells(const Tissue& tissue, const StateView& state, const BoundingBox& region);
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

  double margin_;
  WoundTracker tracker_;
  std::vector<int> cells_, chosen_;  // that are looked at, empty: all; the next ones
  std::optional<Tissue> part_;  // made of them when it is needed
  std::vector<int> vertex_;     // of the tissue, one per vertex of part_
  std::vector<double> x_, y_;
  bool is_exposed_ = false;     // the tracker has the exposure of part_ at (x_, y_), bit for bit
  std::optional<Wound> wound_;
  std::vector<char> exposed_;
};

}  // namespace suture
