// What a trajectory is made of, one item after the other, as the journal holds it. A block of the journal is a sequence
// of items that belong together, for example a frame with its observables and the events before it.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "io/model_archive.hpp"
#include "suture/io/trajectory.hpp"
#include "suture/io/wound_csv.hpp"

namespace suture {

/// Who writes: provenance and program. First item of the first block.
struct HeaderItem {
  Provenance provenance;
  std::string code_version, code_commit, compiler, compiler_flags, simd, libraries;
};

struct StageItem {
  Stage stage = Stage::packing;
  TissueState state;
};

/// Tissue of all frames that follow.
struct TissueItem {
  Tissue tissue;
  SharedValues reference_rest_length;
};

struct FrameItem {
  TrajectoryFrame frame;
};

/// Gives a quantity a number, under which its values follow.
struct QuantityItem {
  std::uint32_t number = 0;
  Quantity quantity;
};

struct ValueItem {
  std::uint32_t number = 0;
  double time = 0.0, value = 0.0;
};

struct SummaryItem {
  std::string json;
  Statistics solver;
};

using TrajectoryItem = std::variant<HeaderItem, StageItem, TissueItem, FrameItem, QuantityItem, ValueItem, StoredEvent,
                                    SummaryItem, Continuation, WoundSample>;

HeaderItem make_header(const Provenance& provenance);

/// Fingerprints of content, stored beside it (run.h5: attribute content_hash) and checked by `suture check`.
std::uint64_t stage_hash(const TissueState& state);
std::uint64_t frame_hash(TrajectoryFrame frame);
/// Chained: the hash of a series is that of its last row, which includes all before it.
std::uint64_t value_hash(double time, double value, std::uint64_t before);
std::uint64_t event_hash(const StoredEvent& event, std::uint64_t before);

template <class Archive>
void exchange_fields(Archive& archive, UnitParameters& u) {
  archive(u.rest_area_um2, u.unsticking_force_nN, u.constriction_rate_um_per_s);
}
template <class Archive>
void exchange_fields(Archive& archive, Provenance& p) {
  archive(p.config_text, p.resolved_config, p.command_line, p.start_time, p.parent, p.seed, p.threads,
          p.position_tolerance, p.rest_length_tolerance, p.units);
}
template <class Archive>
void exchange_fields(Archive& archive, HeaderItem& h) {
  archive(h.provenance, h.code_version, h.code_commit, h.compiler, h.compiler_flags, h.simd, h.libraries);
}
template <class Archive>
void exchange_fields(Archive& archive, StageItem& item) {
  archive(item.stage, item.state);
  if (item.stage < Stage::packing || item.stage > Stage::closure) throw FileError("a stage is not known");
}
template <class Archive>
void exchange_fields(Archive& archive, TissueItem& item) {
  archive(item.tissue, item.reference_rest_length);
  const std::size_t reference = item.reference_rest_length.size();
  if (reference != 0 && reference != static_cast<std::size_t>(item.tissue.vertex_count()))
    throw FileError("the parts of a tissue differ in size");
}
template <class Archive>
void exchange_fields(Archive& archive, Quantity& q) {
  archive(q.name, q.unit, q.description);
}
template <class Archive>
void exchange_fields(Archive& archive, CellField& field) {
  archive(field.quantity, field.values);
}
template <class Archive>
void exchange_fields(Archive& archive, FrameExtras& extras) {
  archive(extras.cell_fields, extras.wound_outline);
}
template <class Archive>
void exchange_fields(Archive& archive, FrameItem& item) {
  archive(item.frame.time, item.frame.purse_string, item.frame.values, item.frame.extras);
}
template <class Archive>
void exchange_fields(Archive& archive, QuantityItem& item) {
  archive(item.number, item.quantity);
}
template <class Archive>
void exchange_fields(Archive& archive, ValueItem& item) {
  archive(item.number, item.time, item.value);
}
template <class Archive>
void exchange_fields(Archive& archive, StoredEvent& event) {
  archive(event.time, event.kind, event.cell, event.vertex);
}
template <class Archive>
void exchange_fields(Archive& archive, SummaryItem& item) {
  archive(item.json, item.solver);
}
template <class Archive>
void exchange_fields(Archive& archive, Continuation& c) {
  archive(c.time, c.reproducible, c.started);
}
template <class Archive>
void exchange_fields(Archive& archive, WoundSample& s) {
  archive(s.time, s.wound_area, s.mean_shape, s.perimeter, s.ring_size, s.parts, s.shortest_segment, s.energy);
}

}  // namespace suture
