// The parts of the exposure test that work on a grid somebody else has built.
#pragma once

#include <numbers>

#include "measure/segment_grid.hpp"
#include "suture/measure/exposure.hpp"

namespace suture {

/// Half the circumference of the probe: own membrane nearer than that along the cell belongs to the same bend and blocks nobody.
inline double own_bend(double probe_radius) { return std::numbers::pi * probe_radius; }

/// Buckets a little larger than a segment: most segments are filed once, few strangers are visited.
inline double grid_bucket_size(const Membrane& membrane) { return 1.2 * membrane.contact_distance; }

/// Centre of the disc of this radius that touches the membrane from outside where these segments meet, on the bisector.
Point probe_centre(const MembraneSegment& before, const MembraneSegment& after, double radius);
Point probe_centre(const Tissue& tissue, const SegmentGrid& grid, int vertex, double radius);

/// Whether p lies inside a cell other than own_cell (-1: any cell).
bool inside_other_cell(const Tissue& tissue, const StateView& state, const SegmentGrid& grid, int own_cell, Point p);

/// watched: one flag per vertex; the others count as neither exposed nor blocked, with margin 0. Empty: all are watched.
void measure_exposure(const Tissue& tissue, const StateView& state, const SegmentGrid& grid, const Membrane& membrane,
                      ExposureRule rule, std::span<const char> watched, Exposure& out);

}  // namespace suture
