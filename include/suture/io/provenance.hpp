// Where a result comes from: everything needed to repeat the run that made it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace suture {

/// What one model unit is worth at the file boundary (model.md section 1).
struct OutputScales {
  double length_um;  ///< sqrt(a0) in um
  double time_min;   ///< sqrt(a0)/omega in min
  double area_um2() const { return length_um * length_um; }
};

/// The program itself, fixed when it was built.
struct BuildInformation {
  std::string_view version;
  std::string_view commit;  ///< with "-dirty" when the source tree had uncommitted changes
  std::string_view compiler;
  std::string_view build_type;
  std::string_view libraries;  ///< "HDF5 1.10.8, SUNDIALS 6.4.1, ..."
};
const BuildInformation& build_information();

/// One run of the program.
struct Provenance {
  std::string config_text;      ///< verbatim, as the user wrote it
  std::string resolved_config;  ///< TOML with every default filled in
  std::string command_line;
  std::string start_time;       ///< ISO 8601, UTC
  std::string parent;           ///< file this run continues; empty when it starts afresh
  std::uint64_t seed = 0;
  int threads = 1;
  double position_tolerance = 0.0;     ///< in units of l0(0)
  double rest_length_tolerance = 0.0;
  OutputScales scales{};
};

/// Now, as "2026-11-22T08:47:31Z".
std::string utc_now();

}  // namespace suture
