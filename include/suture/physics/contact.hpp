// Contact between cells: every vertex of one cell against the smooth membrane of every OTHER cell.
//
//     U = sum_{vertex P} sum_{cell j != cell(P)} U(P, chain_j)      with u(d) of contact_law.hpp
//
// U(P, chain) is the inclusion-exclusion sum of contact_geometry.hpp. Units: energy epsilon, lengths in sqrt(a0).
// Source: Ton et al. 2023, supplement section II; model.md section 3.
// C1 wherever no distance is zero; the second derivative jumps where a distance crosses s (1 + l1) or s (1 + l2) and
// where a vertex passes the end of a segment. A segment's term has no force along the segment.
#pragma once

#include "suture/physics/contact_law.hpp"
#include "suture/physics/term.hpp"

namespace suture {

/// How Contact finds its pairs; the value does not depend on it.
enum class PairSearch {
  bounding_boxes,  ///< vertices outside the widened bounding box of a cell are skipped
  all_pairs,       ///< for tests of the former
};

/// Pure: pairs are found anew at every call. The oracle of the vectorised kernel in ode/.
class Contact final : public EnergyTerm {
 public:
  /// Throws InputError when the parameters are inconsistent (contact_law.hpp).
  Contact(const Tissue& tissue, const ContactParameters& parameters, PairSearch search = PairSearch::bounding_boxes);

  std::string_view name() const override { return "contact"; }
  /// All three throw NumericalError naming cell and vertex for a segment of length zero or a distance of zero.
  double energy(double t, const StateView& state) const override;
  void add_gradient(double t, const StateView& state, MutableStateView gradient) const override;
  void add_hessian(double t, const StateView& state, HessianSink& sink) const override;

  const ContactLaw& law() const { return law_; }

 private:
  Tissue tissue_;
  ContactLaw law_;
  PairSearch search_;
};

}  // namespace suture
