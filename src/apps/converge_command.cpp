// `suture converge CONFIG.toml [--methods ...] [--tolerances ...] [--steps ...] [--seeds ...] [--out DIR]`.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "progress_line.hpp"
#include "stop_request.hpp"
#include "suture/converge/study.hpp"
#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/model/tissue.hpp"

namespace suture {

namespace {

struct Options {
  std::string file, directory = "out";
  std::vector<std::string> overrides, methods{"cvode", "rkc2", "euler"}, seeds;
  std::vector<double> tolerances{1e-2, 1e-3, 1e-4}, steps;
  std::string reference = "cvode", confirmation = "rkc2";
  double reference_tolerance = 0.0, divergence = 0.0;
  int repeats = 1;
  bool quiet = false;
};

/// Reads a word as integrator.method would be read, other spellings and suggestions included.
Method read_method(const std::string& word) {
  return parse_config("", "command line", {"integrator.method=" + word}).integrator.method;
}

void check_positive(const char* option, const std::vector<double>& values, double largest) {
  for (const double value : values)
    if (!(value > 0.0 && value <= largest))
      throw InputError(fmt::format("command line: {}: found {}, allowed numbers > 0{}", option, value,
                                   largest < 1e300 ? fmt::format(" up to {}", largest) : ""));
}

std::uint64_t read_seed(std::string_view word) {
  std::uint64_t seed = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), seed);
  if (failure != std::errc() || end != word.data() + word.size())
    throw InputError(fmt::format("command line: --seeds: found '{}', allowed whole numbers and ranges such as 1-5", word));
  return seed;
}

/// "3" or "1-5".
void add_seeds(const std::string& word, std::vector<std::uint64_t>& seeds) {
  const std::size_t dash = word.find('-');
  const std::uint64_t first = read_seed(std::string_view(word).substr(0, dash));
  const std::uint64_t last = dash == std::string::npos ? first : read_seed(std::string_view(word).substr(dash + 1));
  if (last < first || last - first > 9999)
    throw InputError(fmt::format("command line: --seeds: found the range '{}', allowed up to 10000 seeds in ascending order", word));
  for (std::uint64_t seed = first; seed <= last; ++seed) seeds.push_back(seed);
}

StudyOptions study_options(const Options& options, const Config& config) {
  StudyOptions study;
  for (const std::string& word : options.methods) study.methods.push_back(read_method(word));
  check_positive("--tolerances", options.tolerances, 1.0);
  check_positive("--steps", options.steps, 1e300);
  study.tolerances = options.tolerances;
  std::sort(study.tolerances.begin(), study.tolerances.end(), std::greater());
  study.steps = options.steps;
  if (study.steps.empty()) {
    const double step = integrator_options(config, make_tissue(config).mean_initial_rest_length()).time_step;
    study.steps = {8.0 * step, 4.0 * step, 2.0 * step, step};
  }
  std::sort(study.steps.begin(), study.steps.end(), std::greater());
  for (const std::string& word : options.seeds) add_seeds(word, study.seeds);
  if (study.seeds.empty()) study.seeds = {config.tissue.seed};
  study.repeats = options.repeats;
  study.reference = read_method(options.reference);
  study.confirmation = read_method(options.confirmation);
  study.reference_tolerance = options.reference_tolerance;
  const double tightest = study.tolerances.empty() ? config.integrator.tolerance : study.tolerances.back();
  if (!(study.reference_tolerance > 0.0)) study.reference_tolerance = 0.01 * tightest;
  study.divergence = options.divergence > 0.0 ? options.divergence : tightest;
  return study;
}

std::string command_line(const Options& options, const StudyOptions& study) {
  std::string text = fmt::format("suture converge {} --methods {} --tolerances {} --steps {} --seeds {} --repeats {} --divergence {}", options.file,
                                 fmt::join(options.methods, ","), fmt::join(study.tolerances, ","), fmt::join(study.steps, ","),
                                 fmt::join(study.seeds, ","), options.repeats, study.divergence);
  text += fmt::format(" --reference {} --confirmation {} --reference-tolerance {:g}", options.reference, options.confirmation, study.reference_tolerance);
  for (const std::string& set : options.overrides) text += fmt::format(" --set {}", set);
  return text;
}

void converge(const Options& options, CommandResult& result) {
  const Config config = read_config(options.file, options.overrides);
  const StopRequest stop{std::nullopt};
  StudyRequest request{config, study_options(options, config), {}, [&stop] { return stop.requested(); }, {}};
  const std::filesystem::path directory = options.directory;
  const std::string command = command_line(options, request.options);
  request.row_done = [&](const StudyResult& so_far) { write_study(so_far, request, command, directory); };
  StudyResult study;
  {
    ProgressLine line;
    if (!options.quiet) request.progress = [&line](auto stage, double fraction, auto text) { line.update(stage, fraction, text); };
    study = run_study(request);
  }
  if (!study.rows.empty()) {
    write_study(study, request, command, directory);
    draw_study(study, directory);
  }
  if (!options.quiet) std::cout << study_report(study, request.options) << fmt::format("results in {}\n", options.directory);
  if (study.stopped) result.exit_code = ExitCode::stopped_early;
}

void add_options(CLI::App& command, Options& options) {
  command.add_option("CONFIG", options.file, "configuration file (TOML)")->required();
  command.add_option("--methods", options.methods, "integrators to compare, words of integrator.method")->delimiter(',')->capture_default_str();
  command.add_option("--tolerances", options.tolerances, "of the adaptive methods, in l0")->delimiter(',')->capture_default_str();
  command.add_option("--steps", options.steps, "of the fixed-step methods, in model units [8, 4, 2 and 1 x integrator.time_step]")->delimiter(',');
  command.add_option("--seeds", options.seeds, "tissues to repeat the study on: numbers and ranges such as 1-5 [tissue.seed]")->delimiter(',');
  command.add_option("--repeats", options.repeats, "repetitions of each run; times are medians")->check(CLI::Range(1, 1000))->capture_default_str();
  command.add_option("--divergence", options.divergence, "trajectories count as diverged when the references differ by more than this, in l0 [the tightest tolerance]")->check(CLI::PositiveNumber);
  command.add_option("--reference", options.reference, "method of the reference")->capture_default_str();
  command.add_option("--confirmation", options.confirmation, "second method, which confirms the reference")->capture_default_str();
  command.add_option("--reference-tolerance", options.reference_tolerance, "in l0 [a hundredth of the tightest tolerance]")->check(CLI::PositiveNumber);
  command.add_option("--out", options.directory, "folder for the results (created)")->capture_default_str();
  add_set_option(command, options.overrides);
  command.add_flag("--quiet", options.quiet, "no progress");
}

}  // namespace

void add_converge_command(CLI::App& program, CommandResult& result) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("converge", "compare integrators: error and cost against tolerance or step");
  add_options(*command, *options);
  command->callback([options, &result] { converge(*options, result); });
}

}  // namespace suture
