#include "suture/io/summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "suture/errors.hpp"
#include "suture/io/units.hpp"

namespace suture {
namespace {

// Keeps the order in which keys are written.
using Json = nlohmann::ordered_json;

Json number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

Json number(const std::optional<double>& value, double scale = 1.0) {
  return value ? number(*value * scale) : Json(nullptr);
}

const char* status_name(RunStatus status) {
  switch (status) {
    case RunStatus::closed:
      return "closed";
    case RunStatus::reached_t_end:
      return "reached_t_end";
    case RunStatus::stopped:
      return "stopped";
    case RunStatus::failed:
      return "failed";
  }
  throw FileError("a run status has no name");
}

void add_times(Json& json, const RunSummary& summary, double time_min) {
  const auto add = [&](const char* key, const std::optional<double>& time) {
    json[key] = number(time);
    json[std::string(key) + "_min"] = number(time, time_min);
  };
  add("t_purse_string", summary.t_purse_string);
  add("t_closed", summary.t_closed);
  add("t_50", summary.t_50);
  add("t_25", summary.t_25);
  add("t_10", summary.t_10);
  add("t_05", summary.t_05);
}

void add_cell(Json& json, const CellOutcome& cell, double area) {
  json["shape_initial"] = number(cell.shape_initial);
  json["shape_at_release"] = number(cell.shape_at_release);
  json["shape_final"] = number(cell.shape_final);
  json["area_final"] = number(cell.area_final);
  json["area_final_um2"] = number(cell.area_final * area);
}

Json solver_counts(const Statistics& solver) {
  return {{"rate_evaluations", solver.rate_evaluations},
          {"steps", solver.steps},
          {"explicit_steps", solver.explicit_steps},
          {"newton_iterations", solver.newton_iterations},
          {"linear_iterations", solver.linear_iterations},
          {"error_test_failures", solver.error_test_failures},
          {"convergence_failures", solver.convergence_failures},
          {"restarts", solver.restarts}};
}

}  // namespace

std::string to_json(const RunSummary& summary) {
  const UnitScales scales(summary.units);
  const double area = scales.factor(Dimension::area);
  Json json;
  json["status"] = status_name(summary.status);
  json["seed"] = summary.seed;
  json["k_a"] = number(summary.k_a);
  json["tau"] = number(summary.tau);
  json["xi"] = number(summary.xi);
  add_times(json, summary, scales.time_min());
  json["wound_area_initial"] = number(summary.wound_area_initial);
  json["wound_area_initial_um2"] = number(summary.wound_area_initial, area);
  json["wound_area_max"] = number(summary.wound_area_max);
  json["wound_area_max_um2"] = number(summary.wound_area_max, area);
  json["closure_rate"] = number(summary.closure_rate);
  json["closure_rate_um2_per_min"] = number(summary.closure_rate, scales.factor(Dimension::area_rate));
  json["healed_shape"] = number(summary.healed_shape);
  if (summary.cell) add_cell(json, *summary.cell, area);
  json["events"] = {
      {"yield", summary.events.yield}, {"capture", summary.events.capture}, {"exchange", summary.events.exchange}};
  json["solver"] = solver_counts(summary.solver);
  json["wall_s"] = summary.wall_s;
  return json.dump(2) + "\n";
}

void write_summary(const RunSummary& summary, const std::filesystem::path& path) {
  write_file_atomically(path, to_json(summary));
}

}  // namespace suture
