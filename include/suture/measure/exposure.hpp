// Which cell vertices face free space (model.md section 7).
//
// probe_disc: a disc of radius rho = s(1 + l2)/2 that touches the membrane at the vertex from outside, its centre on
// the bisector of the two segments, overlaps no other cell. That is what a flood fill of the free space reaches, and
// how the published runs found their purse-string vertices (86-91 on the initial wound). contact_free: no membrane of
// another cell within s(1 + l2) of the vertex (63-66 on the same wound). Every contact_free vertex is also probe_disc
// exposed: its probe lies inside the empty disc of radius s(1 + l2).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "suture/measure/membrane.hpp"
#include "suture/model/state.hpp"

namespace suture {

enum class ExposureRule { probe_disc, contact_free };

/// One entry per cell vertex.
struct Exposure {
  std::vector<char> exposed;
  /// Free distance around the tested disc. >= 0 when exposed (saturates at a quarter of the disc's radius). Negative
  /// when blocked: then some membrane intrudes by |margin| and others may intrude further. Either way the flag cannot
  /// change before the distance from the disc's centre to the membranes has changed by |margin|.
  std::vector<double> margin;
  /// A segment that blocks the vertex; -1 when exposed, or when only the inside of another cell blocks it.
  std::vector<int> blocker;
};

/// Reusable workspace: no allocation once it has seen a tissue of the same size. The result is a pure function of
/// (tissue, state); about 60 us for 45 cells of 30 vertices.
class ExposureMeasure {
 public:
  /// Throws InputError unless the membrane has a positive contact distance.
  explicit ExposureMeasure(const Membrane& membrane, ExposureRule rule = ExposureRule::probe_disc);
  ~ExposureMeasure();
  ExposureMeasure(ExposureMeasure&&) noexcept;
  ExposureMeasure& operator=(ExposureMeasure&&) noexcept;

  /// Valid until the next call. Throws NumericalError for a coordinate that is not finite or a segment without length.
  const Exposure& operator()(const Tissue& tissue, const StateView& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One-off form of ExposureMeasure.
Exposure exposed_vertices(const Tissue& tissue, const StateView& state, const Membrane& membrane,
                          ExposureRule rule = ExposureRule::probe_disc);

}  // namespace suture
