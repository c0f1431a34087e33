// Exposure of a few vertices, at the cost of the cells around them.
#pragma once

#include <span>
#include <vector>

#include "measure/exposure_core.hpp"
#include "suture/measure/membrane.hpp"

namespace suture {

/// Good as long as no other cell comes near the vertices than those that are when it is made.
class ExposureProbe {
 public:
  /// cells: ascending, those of `tissue` whose positions can be read; empty: all.
  ExposureProbe(const Tissue& tissue, const StateView& state, const Membrane& membrane, std::span<const int> vertices, std::span<const int> cells);

  /// The largest margin (Exposure::margin, by probe_disc) of the vertices: not negative when one of them is exposed.
  double operator()(const StateView& state);

 private:
  Membrane membrane_;
  std::vector<int> cells_;
  std::vector<int> vertex_;  // of the tissue, one per vertex of part_
  Tissue part_;
  std::vector<char> watched_;
  std::vector<double> x_, y_;
  SegmentGrid grid_;
  Exposure exposure_;
};

}  // namespace suture
