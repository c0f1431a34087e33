// The fields of everything a checkpoint of a run holds, for byte_archive.hpp.
#pragma once

#include "io/model_archive.hpp"
#include "suture/setup/protocol.hpp"

namespace suture {

template <class Archive>
void exchange_fields(Archive& archive, PackingReport& r) {
  archive(r.fraction, r.largest_force, r.compression_steps, r.iterations);
}
template <class Archive>
void exchange_fields(Archive& archive, Packing& p) {
  archive(p.state, p.wall_radius, p.report);
}
template <class Archive>
void exchange_fields(Archive& archive, FireReport& r) {
  archive(r.converged, r.iterations, r.uphill_stops, r.largest_force);
}
template <class Archive>
void exchange_fields(Archive& archive, FireState& s) {
  archive(s.velocity, s.time_step, s.mixing, s.downhill_steps, s.report);
}
template <class Archive>
void exchange_fields(Archive& archive, CompressionState& s) {
  archive(s.packing, s.before, s.asked, s.response, s.progress_mark, s.finishing, s.minimisation);
}
template <class Archive>
void exchange_fields(Archive& archive, EnergyReport& r) {
  archive(r.initial, r.final, r.largest_deviation);
}
template <class Archive>
void exchange_fields(Archive& archive, ConstantEnergyState& s) {
  archive(s.state, s.velocities, s.start, s.steps_done, s.report);
}
template <class Archive>
void exchange_fields(Archive& archive, RelaxationState& s) {
  archive(s.state, s.start, s.initial_step, s.statistics);
}
template <class Archive>
void exchange_fields(Archive& archive, AnnealState& s) {
  archive(s.motion, s.energy, s.relaxation);
}
template <class Archive>
void exchange_fields(Archive& archive, Acceptance& a) {
  archive(a.accepted, a.components, a.largest_hole, a.wound_area, a.reason);
}
template <class Archive>
void exchange_fields(Archive& archive, Preparation& p) {
  archive(p.stage, p.state, p.attempt, p.refused, p.wall_radius, p.packing, p.anneal_energy, p.relaxation,
          p.removed_cells, p.acceptance);
}
template <class Archive>
void exchange_fields(Archive& archive, PreparationState& s) {
  archive(s.so_far, s.step);
}

}  // namespace suture
