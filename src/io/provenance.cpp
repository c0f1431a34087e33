#include "suture/io/provenance.hpp"

#include <ctime>
#include <utility>

#include "suture/io/config.hpp"

namespace suture {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[sizeof "2026-11-22T08:47:31Z"];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

Provenance provenance_of(const Config& config, std::string config_text, std::string command_line) {
  Provenance provenance;
  provenance.config_text = std::move(config_text);
  provenance.resolved_config = write_config(config);
  provenance.command_line = std::move(command_line);
  provenance.start_time = utc_now();
  provenance.parent = config.run.start_from;
  provenance.seed = config.tissue.seed;
  provenance.threads = config.integrator.threads;
  provenance.position_tolerance = config.integrator.tolerance;
  provenance.rest_length_tolerance = config.integrator.rest_length_tolerance;
  provenance.units = config.units;
  return provenance;
}

}  // namespace suture
