// Work-precision studies: one problem, many methods and tolerances or steps, each against one reference.
//
// The reference of a seed is integrated twice, by two different methods, at one tolerance 100 times tighter than the tightest
// tolerance studied. Their difference is reported as the reference's own uncertainty. Single trajectories of a tissue that
// rearranges diverge: two accurate integrations take different branches. The first sample at which the two references differ by
// more than `divergence` (root mean square, in l0) is the divergence time; errors of single runs are measured up to it, and
// errors of means over the seeds over the whole run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "suture/converge/course.hpp"
#include "suture/model/parameters.hpp"
#include "suture/setup/progress.hpp"

namespace suture {

struct StudyOptions {
  std::vector<Method> methods;
  std::vector<double> tolerances;  ///< of the adaptive methods, in l0
  std::vector<double> steps;       ///< of the fixed-step methods, model units
  std::vector<std::uint64_t> seeds;
  int repeats = 1;                 ///< of every run; times are medians
  double divergence = 1e-3;        ///< threshold of divergence, in l0
  Method reference = Method::cvode, confirmation = Method::rkc2;
  double reference_tolerance = 0.0;  ///< in l0
};

/// What was computed at one method and tolerance or step, for one seed or over all.
struct StudyRow {
  Method method = Method::cvode;
  double tolerance_or_dt = 0.0;
  bool confirmation = false;  ///< the second reference against the first: the reference's own uncertainty
  int seeds = 1;              ///< that did not fail
  std::string failure;        ///< of the first seed that failed
  CourseErrors errors;        ///< over seeds: medians; position_max the largest, until and diverged_at the smallest
  std::optional<double> mean_area, mean_shape, mean_t_05;  ///< errors of means over seeds, whole run
  double rate_evaluations = 0.0, steps = 0.0, newton_iterations = 0.0, linear_iterations = 0.0, restarts = 0.0;
  double wall_s = 0.0, cpu_s = 0.0;  ///< medians over repeats, means over seeds
};

struct SeedReference {
  std::uint64_t seed = 0;
  std::optional<double> divergence_time;  ///< empty: never
  CourseErrors uncertainty;               ///< up to the divergence time
  std::vector<SampleDifference> difference;  ///< of the two references, at every sample
};

struct StudyResult {
  std::vector<StudyRow> rows;                    ///< methods in order, coarse to fine; confirmation last
  std::vector<std::pair<std::uint64_t, StudyRow>> seed_rows;
  std::vector<SeedReference> references;
  double rest_length = 0.0;  ///< l0, model units
  bool stopped = false;
};

struct StudyRequest {
  Config config;
  StudyOptions options;
  Progress progress;           ///< may be empty
  std::function<bool()> stop;  ///< may be empty
  std::function<void(const StudyResult&)> row_done;  ///< called after every run; may be empty
};

/// True for euler, verlet and rk4, which take steps instead of tolerances.
bool takes_fixed_steps(Method method);
/// "cvode", "rkc2", ...: the word of integrator.method.
std::string method_name(Method method);

/// Throws InputError for options that contradict each other, NumericalError when preparation or a reference fails.
StudyResult run_study(const StudyRequest& request);

/// converge.csv: one line per row. docs/reference/output-format.md describes the columns.
std::string study_csv(const StudyResult& result);
/// converge_seeds.csv: the same per seed.
std::string seeds_csv(const StudyResult& result);
/// references.csv: how far apart the two references of each seed are, against time.
std::string references_csv(const StudyResult& result);
/// converge.json: the problem, the references and where the numbers come from.
std::string study_json(const StudyResult& result, const StudyRequest& request, const std::string& command_line);
/// Writes converge.csv, converge_seeds.csv, references.csv and converge.json into `directory`, which is created. Throws FileError.
void write_study(const StudyResult& result, const StudyRequest& request, const std::string& command_line,
                 const std::filesystem::path& directory);
/// A table and the verdict on the reference, for people.
std::string study_report(const StudyResult& result, const StudyOptions& options);
/// Writes work_precision.png/.svg and error_tolerance.png/.svg. Throws FileError.
void draw_study(const StudyResult& result, const std::filesystem::path& directory);

}  // namespace suture
