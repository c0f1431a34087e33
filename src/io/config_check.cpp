#include "config_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "suture/errors.hpp"
#include "suture/io/config.hpp"

namespace suture {

namespace {

class Checker {
 public:
  Checker(const Config& config, const OriginOf& origin_of) : config_(config), origin_of_(origin_of) {}

  void check_all() const {
    check_contact();
    check_cells();
    check_packing();
    check_wound();
    check_purse_string();
    check_single_cell();
    check_checkpoint();
  }

 private:
  template <class Value>
  void require(bool condition, std::string_view key, const Value& found, std::string_view allowed) const {
    if (!condition)
      throw InputError(fmt::format("{}: key '{}': found {}, allowed {}", origin_of_(key), key, found, allowed));
  }

  void check_contact() const {
    const auto& [adhesion, range] = std::pair{config_.contact.adhesion, config_.contact.range};
    require(adhesion < range, "contact.adhesion", adhesion, fmt::format("less than contact.range = {}", range));
    require(config_.packing.adhesion < range, "packing.adhesion", config_.packing.adhesion,
            fmt::format("less than contact.range = {}", range));
  }

  void check_cells() const {
    int typed = 0;
    std::set<std::string> names;
    for (const CellType& type : config_.cell_types) {
      require(type.cells >= 1, "cell_type.cells", type.cells, "at least 1 in every [[cell_type]]");
      require(type.name.empty() || names.insert(type.name).second, "cell_type.name", type.name,
              "a name of its own for every [[cell_type]]");
      typed += type.cells;
      require(typed <= config_.tissue.cells, "cell_type.cells", fmt::format("{} cells in all [[cell_type]]", typed),
              fmt::format("at most tissue.cells = {}", config_.tissue.cells));
    }
    const double vertices = static_cast<double>(config_.tissue.cells) * config_.tissue.vertices;
    require(vertices <= largest_vertex_count, "tissue.cells",
            fmt::format("{} cells of {} vertices", config_.tissue.cells, config_.tissue.vertices),
            fmt::format("at most {} vertices in all", largest_vertex_count));
  }

  void check_packing() const {
    const PackingParameters& packing = config_.packing;
    require(packing.initial_fraction <= packing.final_fraction, "packing.initial_fraction", packing.initial_fraction,
            fmt::format("at most packing.final_fraction = {}", packing.final_fraction));
    require(config_.anneal.duration == 0.0 || config_.anneal.time_step <= config_.anneal.duration, "anneal.time_step",
            config_.anneal.time_step, fmt::format("at most anneal.duration = {}", config_.anneal.duration));
  }

  void check_wound() const {
    const WoundParameters& wound = config_.wound;
    if (config_.run.protocol != Protocol::wound_closure || config_.run.last_stage < Stage::ablation) return;
    require(wound.cells < config_.tissue.cells, "wound.cells", wound.cells,
            fmt::format("less than tissue.cells = {}", config_.tissue.cells));
    require(wound.minimum_area <= wound.maximum_area, "wound.minimum_area", wound.minimum_area,
            fmt::format("at most wound.maximum_area = {}", wound.maximum_area));
    require(config_.run.closed_area < wound.maximum_area, "run.closed_area", config_.run.closed_area,
            fmt::format("less than wound.maximum_area = {}", wound.maximum_area));
  }

  void check_purse_string() const {
    const PurseStringParameters& string = config_.purse_string;
    if (!string.enabled) return;
    require(string.law != SpringLaw::relative || string.minimum_rest_length > 0.0, "purse_string.minimum_rest_length",
            string.minimum_rest_length, "a number > 0 when purse_string.law = \"relative\", which divides by it");
    require(string.capture_search != CaptureSearch::published || string.event_handling == EventHandling::each_step,
            "purse_string.capture_search", "published", "boundary unless purse_string.event_handling = \"each_step\"");
  }

  void check_single_cell() const {
    if (config_.run.protocol == Protocol::wound_closure) return;
    require(config_.tissue.cells == 1, "tissue.cells", config_.tissue.cells,
            fmt::format("1 when run.protocol = {}", config_value(config_, "run.protocol")));
    const CompressionParameters& compression = config_.compression;
    if (config_.run.protocol == Protocol::compression)
      require(compression.closing_time <= compression.duration, "compression.closing_time", compression.closing_time,
              fmt::format("at most compression.duration = {}", compression.duration));
  }

  void check_checkpoint() const {
    const CheckpointParameters& checkpoint = config_.checkpoint;
    require(!checkpoint.reproducible || std::isfinite(checkpoint.interval), "checkpoint.reproducible", "true",
            "false unless checkpoint.interval is finite");
  }

  static constexpr double largest_vertex_count = 2e8;  // state offsets are 32-bit integers

  const Config& config_;
  const OriginOf& origin_of_;
};

}  // namespace

void check_config(const Config& config, const OriginOf& origin_of) { Checker{config, origin_of}.check_all(); }

void check_config(const Config& config) {
  check_config(config, [](std::string_view) { return std::string{"configuration"}; });
}

}  // namespace suture
