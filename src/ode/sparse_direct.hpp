// The whole matrix I + gamma H of an implicit step, assembled and factored: what the structured preconditioner and the
// matrix-free product are checked against. It allocates, and a set-up takes a thousand times as long.
#pragma once

#include <Eigen/SparseCholesky>
#include <span>
#include <vector>

#include "ode/block_list.hpp"
#include "ode/contact_factors.hpp"
#include "ode/padded_tissue.hpp"

namespace suture {

class SparseDirect {
 public:
  SparseDirect(const Tissue& tissue, const PaddedTissue& padded) : tissue_(&tissue), padded_(&padded) {}

  /// Factors the matrix that TissueOde::product applies: the linearisation held by `padded`, the contact factors and the
  /// extra terms, for `points` cell and ring vertices. False when it is not positive definite.
  bool factor(double gamma, int points, const ContactFactors& contacts, const BlockList& extra);
  /// z = (I + gamma H)^-1 r, on position vectors (all x, then all y). r and z may not alias.
  void solve(std::span<const double> r, std::span<double> z) const;

 private:
  /// Adds the element matrix (a, b) -> value(a, b), symmetric, on the degrees of freedom `at`, of which some may coincide.
  template <class Value>
  void add_element(std::span<const int> at, Value&& value);
  /// Degrees of freedom of some points: x0, y0, x1, y1 ...
  template <class... Point>
  auto freedoms(Point... point) const;
  void add_shell(double gamma, int cell);
  void add_contact(double gamma, const kernels::ContactFactor& factor);
  void add_extra(double gamma, const BlockList& extra);

  const Tissue* tissue_;
  const PaddedTissue* padded_;
  int points_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;  ///< of the lower triangle
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace suture
