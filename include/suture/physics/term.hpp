// The two small interfaces every physicist will meet. A term is a pure function of (t, y): it keeps no mutable state.
//
// These implementations are written to be read and to be exact; they are the production path for light terms and the
// test oracle of the vectorised kernels in ode/. To add a term, see docs/how-to/add-a-term.md.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "suture/model/state.hpp"

namespace suture {

/// 2 x 2 block, row major: {xx, xy, yx, yy}.
using Block = std::array<double, 4>;

/// Receives second derivatives d2U/(dr_i dr_j) of point pairs.
class HessianSink {
 public:
  virtual ~HessianSink() = default;
  /// Adds `block` at (i, j) and, when i != j, its transpose at (j, i).
  virtual void add_block(int i, int j, const Block& block) = 0;
  /// Adds coefficient * g g^T, g = (gx[k], gy[k]) at points first + k.
  virtual void add_rank_one(int first, double coefficient, std::span<const double> gx, std::span<const double> gy) = 0;
};

/// One energy U_term(t, r, l0).
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;
  virtual std::string_view name() const = 0;
  virtual double energy(double t, const StateView& state) const = 0;
  /// Adds dU/dr (NOT the force) to gradient.x, gradient.y; leaves gradient.rest_length alone.
  virtual void add_gradient(double t, const StateView& state, MutableStateView gradient) const = 0;
  /// Adds d2U/dr2 at fixed rest lengths.
  virtual void add_hessian(double t, const StateView& state, HessianSink& sink) const = 0;
};

/// out += H v for position vectors (2 points(): all x, then all y), without assembling H.
void add_hessian_product(const EnergyTerm& term, double t, const StateView& state, std::span<const double> vx,
                         std::span<const double> vy, std::span<double> outx, std::span<double> outy);

}  // namespace suture
