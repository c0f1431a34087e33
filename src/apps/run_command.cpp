// `suture run CONFIG.toml [--out DIR] [--set key=value ...]`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "progress_line.hpp"
#include "stop_request.hpp"
#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/simulate/run.hpp"

namespace suture {

namespace {

struct Options {
  std::string file, directory = "out";
  std::vector<std::string> overrides;
  std::string max_wall;
  bool quiet = false, resume = false, overwrite = false;
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

std::string verdict(const RunOutcome& outcome) {
  const RunSummary& s = outcome.summary;
  const auto time = [](const std::optional<double>& t) { return t ? fmt::format("{:.1f}", *t) : std::string("never"); };
  switch (s.status) {
    case RunStatus::closed: return fmt::format("wound closed at t = {}", time(s.t_closed));
    case RunStatus::reached_t_end:
      return s.wound_area_max ? fmt::format("end time reached, wound still open (half closed at {})", time(s.t_50)) : "finished";
    case RunStatus::stopped: return "stopped early, --resume continues";
    case RunStatus::failed: return "failed";
  }
  return "";
}

/// False when nothing is left to be done.
bool is_to_be_run(const Options& options) {
  const DirectoryContent content = content_of(options.directory);
  if (content == DirectoryContent::unfinished && !options.resume && !options.overwrite)
    throw InputError(fmt::format("{}: holds a run that is not finished; --resume continues it, --overwrite starts again",
                                 options.directory));
  return !(options.resume && content == DirectoryContent::finished);
}

std::string automatic_choice(const Statistics& solver) {
  return fmt::format("method auto: {} of {} steps with rkc2, the others with cvode (preparation included)\n", solver.explicit_steps, solver.steps);
}

void run(const Options& options, CommandResult& result) {
  const Config config = read_config(options.file, options.overrides);
  const std::optional<double> max_wall =
      options.max_wall.empty() ? std::nullopt : std::optional(parse_wall_time(options.max_wall, "--max-wall"));
  if (!is_to_be_run(options)) {
    remove_leftovers(options.directory);
    if (!options.quiet) std::cout << fmt::format("already finished; results in {}\n", options.directory);
    return;
  }
  const StopRequest stop(max_wall);
  RunRequest request{config, provenance_of(config, read_text(options.file), command_line(options)), options.directory, {}, [&stop] { return stop.requested(); },
                     options.resume};
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
  command->add_option_function<std::string>(
      "--seed", [options](const std::string& seed) { options->overrides.push_back("tissue.seed=" + seed); }, "another tissue: --set tissue.seed=N");
  command->add_flag("--resume", options->resume, "continue a run that was stopped or killed; start it if there is none");
  command->add_flag("--overwrite", options->overwrite, "start again although DIR holds an unfinished run");
  command->add_option("--max-wall", options->max_wall, "stop in time, with a checkpoint: 90s, 30min, 2h, 1d or [D-]HH:MM:SS");
  command->add_flag("--quiet", options->quiet, "no progress");
  command->callback([options, &result] { run(*options, result); });
}

}  // namespace suture
