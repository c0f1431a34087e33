// Where a result comes from: everything needed, besides the program itself (version.hpp), to repeat the run.
#pragma once

#include <cstdint>
#include <string>

#include "suture/model/parameters.hpp"

namespace suture {

struct Provenance {
  std::string config_text;      ///< verbatim, as the user wrote it
  std::string resolved_config;  ///< TOML with every default filled in
  std::string command_line;
  std::string start_time;  ///< ISO 8601, UTC
  std::string parent;      ///< file this run continues; empty when it starts afresh
  std::uint64_t seed = 0;
  int threads = 1;
  double position_tolerance = 0.0;  ///< in units of l0(0)
  double rest_length_tolerance = 0.0;
  UnitParameters units;  ///< what one model unit stands for
};

/// Now, as "2026-11-22T08:47:31Z".
std::string utc_now();

/// Of a run of `config` that starts now.
Provenance provenance_of(const Config& config, std::string config_text, std::string command_line);

}  // namespace suture
