#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "suture/converge/study.hpp"
#include "suture/io/config.hpp"
#include "suture/io/provenance.hpp"
#include "suture/version.hpp"

namespace suture {

namespace {

// The first nine columns are a contract with other tools.
constexpr const char* columns =
    "method,tolerance_or_dt,error_position,error_area,error_shape,error_t5,rate_evaluations,steps,wall_s,"
    "error_position_max,cpu_s,newton_iterations,linear_iterations,restarts,error_until,diverged_at,"
    "mean_error_area,mean_error_shape,mean_error_t5,seeds,role,status\n";

std::string field(const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : std::string(); }

std::string line(const StudyRow& row) {
  const CourseErrors& e = row.errors;
  const bool measured = row.seeds > 0;
  const auto error = [&](double value) { return measured ? fmt::format("{:.6g}", value) : std::string(); };
  return fmt::format("{},{:g},{},{},{},{},{:.10g},{:.10g},{:.4g},{},{:.4g},{:.10g},{:.10g},{:.10g},{},{},{},{},{},{},{},{}\n",
                     method_name(row.method), row.tolerance_or_dt, error(e.position), error(e.area), field(e.shape), field(e.t_05),
                     row.rate_evaluations, row.steps, row.wall_s, error(e.position_max), row.cpu_s, row.newton_iterations,
                     row.linear_iterations, row.restarts, error(e.until), field(e.diverged_at), field(row.mean_area),
                     field(row.mean_shape), field(row.mean_t_05), row.seeds, row.confirmation ? "confirmation" : "run",
                     row.failure.empty() ? "done" : "failed");
}

/// Errors not clearly above what the reference itself may be wrong by.
bool unresolved(const StudyRow& row, const StudyResult& result) {
  double uncertainty = 0.0;
  for (const SeedReference& reference : result.references) uncertainty = std::max(uncertainty, reference.uncertainty.position);
  return row.errors.position < 3.0 * uncertainty;
}

std::string report_line(const StudyRow& row, bool uncertain) {
  if (row.seeds == 0) return fmt::format("  {:<8} {:>9.3g}  failed: {}\n", method_name(row.method), row.tolerance_or_dt, row.failure);
  const CourseErrors& e = row.errors;
  const auto text = [](const std::optional<double>& value) { return value ? fmt::format("{:.1e}", *value) : std::string("-"); };
  return fmt::format("  {:<8} {:>9.3g}  {:>8.1e}{} {:>8.1e} {:>8.1e} {:>8} {:>8}  {:>9.0f} {:>8.0f} {:>8.3g} {:>8.3g}\n", method_name(row.method),
                     row.tolerance_or_dt, e.position, uncertain ? '*' : ' ', e.position_max, e.area, text(e.shape), text(e.t_05), row.rate_evaluations,
                     row.steps, row.wall_s, row.cpu_s);
}

}  // namespace

std::string study_csv(const StudyResult& result) {
  std::string text = columns;
  for (const StudyRow& row : result.rows) text += line(row);
  return text;
}

std::string seeds_csv(const StudyResult& result) {
  std::string text = fmt::format("seed,{}", columns);
  for (const auto& [seed, row] : result.seed_rows) text += fmt::format("{},{}", seed, line(row));
  return text;
}

std::string references_csv(const StudyResult& result) {
  std::string text = "seed,time,difference_position,difference_position_max,difference_area,difference_shape\n";
  for (const SeedReference& reference : result.references)
    for (const SampleDifference& d : reference.difference)
      text += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{}\n", reference.seed, d.time, d.position, d.position_max, d.area, field(d.shape));
  return text;
}

std::string study_json(const StudyResult& result, const StudyRequest& request, const std::string& command_line) {
  using Json = nlohmann::ordered_json;
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  const StudyOptions& options = request.options;
  Json references = Json::array();
  for (const SeedReference& reference : result.references)
    references.push_back({{"seed", reference.seed},
                          {"divergence_time", number(reference.divergence_time)},
                          {"compared_until", reference.uncertainty.until},
                          {"uncertainty_position", reference.uncertainty.position},
                          {"uncertainty_position_max", reference.uncertainty.position_max},
                          {"uncertainty_area", reference.uncertainty.area},
                          {"uncertainty_shape", number(reference.uncertainty.shape)},
                          {"uncertainty_t5", number(reference.uncertainty.t_05)}});
  double load[3] = {-1.0, -1.0, -1.0};
  getloadavg(load, 3);
  const BuildInformation& build = build_information();
  const Json json{{"command_line", command_line},
                  {"finished", !result.stopped},
                  {"written", utc_now()},
                  {"rest_length", result.rest_length},
                  {"reference_method", method_name(options.reference)},
                  {"confirmation_method", method_name(options.confirmation)},
                  {"reference_tolerance", options.reference_tolerance},
                  {"divergence_threshold", options.divergence},
                  {"repeats", options.repeats},
                  {"references", references},
                  {"load_average", load[0]},
                  {"version", build.version},
                  {"commit", build.commit},
                  {"uncommitted_changes", build.dirty},
                  {"compiler", build.compiler},
                  {"libraries", build.libraries},
                  {"config", write_config(request.config)}};
  return json.dump(2) + "\n";
}

void write_study(const StudyResult& result, const StudyRequest& request, const std::string& command_line,
                 const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  write_file_atomically(directory / "converge.csv", study_csv(result));
  write_file_atomically(directory / "converge_seeds.csv", seeds_csv(result));
  write_file_atomically(directory / "references.csv", references_csv(result));
  write_file_atomically(directory / "converge.json", study_json(result, request, command_line));
}

std::string study_report(const StudyResult& result, const StudyOptions& options) {
  std::string text = fmt::format("errors in l0 = {:.6g} (positions), a0 (area); reference {} at {:.3g}, confirmed by {}\n", result.rest_length,
                                 method_name(options.reference), options.reference_tolerance, method_name(options.confirmation));
  text += fmt::format("  {:<8} {:>9}  {:>8}  {:>8} {:>8} {:>8} {:>8}  {:>9} {:>8} {:>8} {:>8}\n", "method", "tol or dt", "rms", "max", "area",
                      "shape", "t_05", "rates", "steps", "wall s", "cpu s");
  for (const StudyRow& row : result.rows)
    if (!row.confirmation) text += report_line(row, unresolved(row, result));
  if (std::any_of(result.rows.begin(), result.rows.end(), [&](const StudyRow& row) { return !row.confirmation && row.seeds > 0 && unresolved(row, result); }))
    text += "  * less than three times the reference's own uncertainty: not resolved\n";
  for (const SeedReference& reference : result.references) {
    text += fmt::format("seed {}: the two references differ by {:.1e} l0 (rms), {:.1e} (max), area {:.1e}", reference.seed,
                        reference.uncertainty.position, reference.uncertainty.position_max, reference.uncertainty.area);
    if (reference.divergence_time)
      text += fmt::format(" up to t = {:.4g}; from t = {:.4g} on they differ by more than {:g} l0, so single runs are compared up to there\n",
                          reference.uncertainty.until, *reference.divergence_time, options.divergence);
    else
      text += "; they do not diverge\n";
  }
  return text;
}

}  // namespace suture
