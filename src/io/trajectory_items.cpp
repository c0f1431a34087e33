#include "io/trajectory_items.hpp"

#include <algorithm>

#include "io/content_hash.hpp"
#include "suture/version.hpp"

namespace suture {

HeaderItem make_header(const Provenance& provenance) {
  const BuildInformation& build = build_information();
  return {.provenance = provenance,
          .code_version = std::string(build.version),
          .code_commit = std::string(build.commit) + (build.dirty ? "-dirty" : ""),
          .compiler = std::string(build.compiler),
          .compiler_flags = std::string(build.flags),
          .simd = std::string(build.simd),
          .libraries = std::string(build.libraries)};
}

std::uint64_t stage_hash(const TissueState& state) { return content_hash(to_bytes(state)); }

std::uint64_t frame_hash(TrajectoryFrame frame) {
  // HDF5 hands the fields back in the order of their names.
  std::sort(frame.extras.cell_fields.begin(), frame.extras.cell_fields.end(),
            [](const CellField& a, const CellField& b) { return a.quantity.name < b.quantity.name; });
  return content_hash(to_bytes(FrameItem{std::move(frame)}));
}

std::uint64_t value_hash(double time, double value, std::uint64_t before) {
  return content_hash(to_bytes(std::pair(time, value)), before);
}

std::uint64_t event_hash(const StoredEvent& event, std::uint64_t before) { return content_hash(to_bytes(event), before); }

}  // namespace suture
