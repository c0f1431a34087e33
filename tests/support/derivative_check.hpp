// Checks the gradient and Hessian of an energy term by the ORDER of their Taylor remainders, which no tolerance can
// fake:
//
//     |U(r + h v) - U(r) - h g.v|        ~ h^2  when g is the gradient,      ~ h   otherwise
//     |g(r + h v) - g(r) - h H v|        ~ h^2  when H is the Hessian,       ~ h   otherwise
#pragma once

#include <cstdint>
#include <string>

#include "suture/model/state.hpp"
#include "suture/physics/term.hpp"

namespace suture::test {

struct DerivativeReport {
  int checked = 0;              ///< directions that told something: energy, gradient or Hessian were not all zero
  double gradient_order = 2.0;  ///< worst median order of the energy remainder; 2 when every remainder is rounding
  double hessian_order = 2.0;   ///< same of the gradient remainder
  double asymmetry = 0.0;       ///< largest |H - H^T| over the largest |H|
  double product_error = 0.0;   ///< largest |H v by blocks - assembled H v| over the largest |H v|
  std::string worst;            ///< the component whose gradient change differs most from H v: expected, got, step

  /// Orders above 1.8 (kinks and rounding leave a little), symmetric, product equal to assembly, and something checked.
  bool passed() const;
  std::string text() const;
};

/// Tries `directions` random directions. Steps are small against the distance to the next kink of the contact law, and
/// large against rounding.
DerivativeReport check_derivatives(const EnergyTerm& term, const TissueState& state, std::uint64_t seed,
                                   int directions = 5);

}  // namespace suture::test
