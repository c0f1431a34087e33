// summary.json: what a run came to, in one small file. The key names are a contract with other tools.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "suture/integrate/integrator.hpp"
#include "suture/model/parameters.hpp"

namespace suture {

enum class RunStatus { closed, reached_t_end, stopped, failed };

struct EventCounts {
  std::int64_t yield = 0;
  std::int64_t capture = 0;
  std::int64_t exchange = 0;
};

/// What a one-cell experiment came to.
struct CellOutcome {
  double shape_initial = 0.0;
  std::optional<double> shape_at_release;  ///< compression: when the plates were taken away
  double shape_final = 0.0;
  double area_final = 0.0;
};

/// Model units. t_50 .. t_05: time since the purse string started at which the wound is that percentage of its
/// maximum; empty if never. Not every protocol has a wound: what does not apply stays empty and becomes null.
struct RunSummary {
  RunStatus status = RunStatus::stopped;
  std::uint64_t seed = 0;
  double k_a = 0.0;
  double tau = 0.0;
  double xi = 0.0;
  std::optional<double> t_purse_string;  ///< simulation time at which the purse string started
  std::optional<double> t_closed;        ///< since the purse string started, like t_50 .. t_05
  std::optional<double> t_50, t_25, t_10, t_05;
  std::optional<double> wound_area_initial, wound_area_max;
  std::optional<double> closure_rate;  ///< 0.95 A_max / (time from A_max to 0.05 A_max)
  std::optional<double> healed_shape;
  std::optional<CellOutcome> cell;  ///< its keys appear only in summaries of one-cell experiments
  EventCounts events;
  Statistics solver;
  std::map<std::string, double> wall_s;  ///< seconds by stage
  UnitParameters units;
};

/// JSON text, indented. Each dimensional result appears twice: in model units, and in um and min under a key that ends
/// in the unit. Numbers that JSON cannot hold (an infinite tau) become the strings "inf", "-inf" or "nan".
std::string to_json(const RunSummary& summary);

/// Writes DIR/summary.json so that either the old or the new file is there, whole. Throws FileError.
void write_summary(const RunSummary& summary, const std::filesystem::path& path);

}  // namespace suture
