// Seeded random tissues for tests: packed, overlapping, non-convex, with unequal cells.
#pragma once

#include <cstdint>
#include <random>

#include "suture/model/state.hpp"

namespace suture::test {

/// Uniform in [low, high), the same on every platform.
double uniform(std::mt19937_64& engine, double low, double high);

struct RandomTissueOptions {
  int rows = 2, columns = 3;  ///< cells on a jittered triangular lattice
  int minimum_vertices = 9, maximum_vertices = 14;
  double spacing = 0.82;   ///< of the lattice, in units of a cell's diameter plus one membrane; < 1 overlaps
  double roughness = 0.2;  ///< relative amplitude of the outline's waves: concave corners
  double strain = 0.15;    ///< current l0 differ from l by up to this fraction
};

/// Counter-clockwise cells without self-crossings, no purse string, materials that differ from cell to cell.
TissueState random_tissue(std::uint64_t seed, const RandomTissueOptions& options = {});

/// A perturbation of every position, uniform in [-amplitude, amplitude]; rest lengths zero. Length layout().size().
std::vector<double> random_direction(const TissueState& state, std::uint64_t seed, double amplitude = 1.0);

}  // namespace suture::test
