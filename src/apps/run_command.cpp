// `suture run CONFIG.toml [--out DIR] [--set key=value ...]`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>

#include "commands.hpp"
#include "progress_line.hpp"
#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/simulate/run.hpp"

namespace suture {

namespace {

volatile std::sig_atomic_t stop_requested = 0;

/// The first signal asks for an orderly stop, the second one is obeyed at once.
void on_signal(int signal) {
  if (stop_requested != 0) std::_Exit(128 + signal);
  stop_requested = 1;
}

struct Options {
  std::string file, directory = "out";
  std::vector<std::string> overrides;
  bool quiet = false;
};

std::string read_text(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string command_line(const Options& options) {
  std::string text = fmt::format("suture run {} --out {}", options.file, options.directory);
  for (const std::string& set : options.overrides) text += fmt::format(" --set {}", set);
  return text;
}

Provenance provenance_of(const Options& options, const Config& config) {
  Provenance provenance;
  provenance.config_text = read_text(options.file);
  provenance.resolved_config = write_config(config);
  provenance.command_line = command_line(options);
  provenance.start_time = utc_now();
  provenance.parent = config.run.start_from;
  provenance.seed = config.tissue.seed;
  provenance.threads = config.integrator.threads;
  provenance.position_tolerance = config.integrator.tolerance;
  provenance.rest_length_tolerance = config.integrator.rest_length_tolerance;
  provenance.units = config.units;
  return provenance;
}

std::string verdict(const RunOutcome& outcome) {
  const RunSummary& s = outcome.summary;
  const auto time = [](const std::optional<double>& t) { return t ? fmt::format("{:.1f}", *t) : std::string("never"); };
  switch (s.status) {
    case RunStatus::closed: return fmt::format("wound closed at t = {}", time(s.t_closed));
    case RunStatus::reached_t_end:
      return s.wound_area_max ? fmt::format("end time reached, wound still open (half closed at {})", time(s.t_50)) : "finished";
    case RunStatus::stopped: return "stopped early";
    case RunStatus::failed: return "failed";
  }
  return "";
}

std::string automatic_choice(const Statistics& solver) {
  return fmt::format("method auto: {} of {} steps with rkc2, the others with cvode (preparation included)\n", solver.explicit_steps, solver.steps);
}

void run(const Options& options, CommandResult& result) {
  const Config config = read_config(options.file, options.overrides);
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  RunRequest request{config, provenance_of(options, config), options.directory, {}, [] { return stop_requested != 0; }};
  RunOutcome outcome;
  {
    ProgressLine line;
    if (!options.quiet) request.progress = [&line](auto stage, double fraction, auto text) { line.update(stage, fraction, text); };
    outcome = run_protocol(request);
  }
  if (!options.quiet) std::cout << fmt::format("{}; results in {}\n", verdict(outcome), options.directory);
  if (!options.quiet && config.integrator.method == Method::automatic) std::cout << automatic_choice(outcome.summary.solver);
  if (outcome.summary.status == RunStatus::failed) throw NumericalError(outcome.failure + fmt::format("; what was computed is in {}", options.directory));
  if (outcome.summary.status == RunStatus::stopped) result.exit_code = ExitCode::stopped_early;
}

}  // namespace

void add_run_command(CLI::App& program, CommandResult& result) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("run", "run a simulation");
  command->add_option("CONFIG", options->file, "configuration file (TOML)")->required();
  command->add_option("--out", options->directory, "folder for the results (created)")->capture_default_str();
  add_set_option(*command, options->overrides);
  command->add_flag("--quiet", options->quiet, "no progress");
  command->callback([options, &result] { run(*options, result); });
}

}  // namespace suture
