// How rest lengths flow: the plastic membrane with shape memory.
//
//     dl0/dt = -[ (l0 - l) + xi (l - l0_ref) ] / tau
//
// l: current length of the segment; l0_ref: rest length before wounding; tau = eta/k_l; xi >= 0 (tau_s = tau/xi).
// Units: lengths in sqrt(a0), time in b a0/epsilon; xi is a number. tau = infinity: elastic, the rate is exactly zero.
// Source: Ton et al. 2023, Eq. 5 and Eq. 10 with the restoring sign (model.md sections 4 and 9). Linear in l0 and l.
// At fixed l, l0 relaxes to (1 - xi) l + xi l0_ref; for xi > 1 that target is negative once l > l0_ref xi/(xi - 1).
#pragma once

#include <span>

#include "suture/model/state.hpp"

namespace suture {

inline double rest_length_rate(double rest_length, double length, double reference, double tau, double memory) {
  return -((rest_length - length) + memory * (length - reference)) / tau;
}

/// The rest length that solves l0 - psi = gamma dl0/dt at length `length`: the exact elimination of the rest lengths
/// from an implicit step,
///     l0 = [ psi + (gamma/tau) ((1 - xi) l + xi l0_ref) ] / (1 + gamma/tau).
inline double implicit_rest_length(double psi, double gamma, double length, double reference, double tau,
                                   double memory) {
  const double ratio = gamma / tau;
  return (psi + ratio * ((1.0 - memory) * length + memory * reference)) / (1.0 + ratio);
}

/// d l0/d l of the elimination above.
inline double implicit_rest_length_slope(double gamma, double tau, double memory) {
  const double ratio = gamma / tau;
  return ratio * (1.0 - memory) / (1.0 + ratio);
}

/// Adds dl0/dt of every segment to rate.rest_length, with tau and xi of its cell.
/// reference: l0_ref, one per segment (empty: l0(0)).
void add_rest_length_rate(const Tissue& tissue, std::span<const double> reference, const StateView& state,
                          MutableStateView rate);

}  // namespace suture
