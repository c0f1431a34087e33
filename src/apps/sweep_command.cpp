// `suture sweep SWEEP.toml [--out DIR] [--jobs N] [--list] [--run-index K]`.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "commands.hpp"
#include "progress_line.hpp"
#include "stop_request.hpp"
#include "suture/errors.hpp"
#include "suture/io/sweep_file.hpp"
#include "suture/sweep/claim.hpp"
#include "suture/sweep/collect.hpp"
#include "suture/sweep/pool.hpp"

namespace suture {

namespace {

struct Options {
  std::string file, directory = "out", seeds;
  std::vector<std::string> overrides;
  int jobs = 0, run_index = -1;
  double lease_s = 300.0, tables_every_s = 60.0;
  bool resume = false, list = false, tables = false, quiet = false;
};

std::string status_of(const SweepFolder& folder, const SweepRun& run) {
  if (const auto record = finished_record(folder, run)) return record->status;
  const bool started = std::filesystem::exists(folder.claims());
  return started && Claim::held(folder.claims(), run.key, folder.lease_s) ? "running" : "waiting";
}

void list_runs(const SweepFolder& folder, const SweepPlan& plan) {
  std::string head = "index,run";
  for (const std::string& column : plan.columns) head += "," + column;
  std::cout << head << ",seed,status\n";
  for (const SweepRun& run : plan.runs) {
    std::string line = fmt::format("{},{}", run.index, run.key);
    for (const std::string& value : plan.nodes[run.node].values) line += "," + value;
    std::cout << fmt::format("{},{},{}\n", line, run.config.tissue.seed, status_of(folder, run));
  }
}

/// Only one run of the plan, so that the pool does with it what it does with all.
SweepPlan only(const SweepPlan& plan, int index) {
  if (index < 0 || index >= static_cast<int>(plan.runs.size()))
    throw InputError(fmt::format("command line: --run-index: found {}, allowed 0 to {} (see suture sweep --list)", index,
                                 plan.runs.size() - 1));
  return {plan.columns, plan.nodes, {plan.runs[index]}};
}

std::string verdict(const SweepProgress& progress) {
  return fmt::format("{} of {} runs{}", progress.finished, progress.total,
                     progress.failed > 0 ? fmt::format(", {} failed", progress.failed) : "");
}

struct SweepEnd {
  bool complete = false;
  SweepProgress progress;
};

/// The tables while a sweep goes on: not more often than asked for, and never for more than a twentieth of the time.
class TablesInBetween {
 public:
  TablesInBetween(const SweepFolder& folder, const SweepPlan& plan, double every_s) : folder_(folder), plan_(plan), every_s_(every_s) {}
  void run_ended() {
    const Clock::time_point start = Clock::now();
    if (std::chrono::duration<double>(start - last_).count() < std::max(every_s_, 20.0 * took_s_)) return;
    collect_sweep(folder_, plan_);
    last_ = Clock::now();
    took_s_ = std::chrono::duration<double>(last_ - start).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  const SweepFolder& folder_;
  const SweepPlan& plan_;
  double every_s_, took_s_ = 0.0;
  Clock::time_point last_ = Clock::now();
};

SweepEnd execute(const Options& options, const SweepFolder& folder, const SweepPlan& plan, bool with_tables) {
  const StopRequest stop{std::nullopt};
  ProgressLine line;
  SweepEnd end;
  TablesInBetween tables(folder, plan, options.tables_every_s);
  using Clock = std::chrono::steady_clock;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  Clock::time_point written = Clock::now();
  const auto report = [&](const SweepProgress& progress) {
    end.progress = progress;
    if (with_tables && !progress.last.empty()) tables.run_ended();
    // A log wants a line when something has ended, and a sign of life once a minute; a terminal a living one.
    if (options.quiet || (!terminal && progress.last.empty() && Clock::now() - written < std::chrono::minutes(1))) return;
    written = Clock::now();
    const int to_do = progress.total - progress.finished_before;
    const double fraction = to_do > 0 ? static_cast<double>(progress.finished - progress.finished_before) / to_do : 1.0;
    line.update("sweep", fraction, fmt::format("{}, {} running{}{}", verdict(progress), progress.running, progress.last.empty() ? "" : "; ", progress.last));
  };
  end.complete = execute_sweep(folder, plan, {.jobs = options.jobs, .progress = report, .stop = [&stop] { return stop.requested(); }});
  return end;
}

void sweep(const Options& options, CommandResult& result) {
  PlanOptions plan_options{options.overrides, {}};
  if (!options.seeds.empty()) plan_options.seeds = parse_seeds(options.seeds, "command line: --seeds");
  const SweepPlan plan = make_plan(read_sweep_file(options.file), plan_options);
  const SweepFolder folder{options.directory, options.lease_s};
  if (options.list) return list_runs(folder, plan);
  const bool one = options.run_index >= 0;
  const SweepPlan selected = one ? only(plan, options.run_index) : plan;
  folder.create();
  if (options.tables) return collect_sweep(folder, plan);
  const SweepEnd end = execute(options, folder, selected, !one);
  if (!one) collect_sweep(folder, plan);
  if (!options.quiet) std::cout << fmt::format("{}; results in {}\n", verdict(end.progress), options.directory);
  if (!end.complete) {
    result.exit_code = ExitCode::stopped_early;
  } else if (end.progress.failed > 0) {
    throw NumericalError(fmt::format("{} of {} runs failed; the reasons are in {}", end.progress.failed, end.progress.total,
                                     one ? (folder.run(selected.runs[0]) / "done.json").string() : (folder.root / "sweep.csv").string()));
  }
}

}  // namespace

void add_sweep_command(CLI::App& program, CommandResult& result) {
  const auto options = std::make_shared<Options>();
  options->jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  CLI::App* command = program.add_subcommand("sweep", "run a campaign: a grid of parameters, several seeds each");
  command->add_option("SWEEP", options->file, "what to run (TOML, see docs/how-to/sweep.md)")->required();
  command->add_option("--out", options->directory, "folder of the sweep (created); what is finished there is not repeated")->capture_default_str();
  command->add_option("--jobs", options->jobs, "runs at the same time")->check(CLI::Range(1, 4096))->capture_default_str();
  command->add_option("--seeds", options->seeds, "other seeds than those of the file, such as 1-5 or 1,2,7-9");
  add_set_option(*command, options->overrides);
  auto* list = command->add_flag("--list", options->list, "print the runs and do nothing");
  command->add_option("--run-index", options->run_index, "execute one run of the list, for batch systems")
      ->check(CLI::NonNegativeNumber)->excludes(list);
  command->add_flag("--tables", options->tables, "write the tables of what is finished and run nothing")->excludes(list);
  command->add_option("--tables-every", options->tables_every_s, "seconds between two writings of the tables while the sweep goes on; they follow the end of a run")
      ->check(CLI::Range(0.0, 1e9))->capture_default_str();
  command->add_option("--lease", options->lease_s, "seconds without a sign of life after which a worker on another machine counts as dead")
      ->check(CLI::Range(1.0, 1e6))->capture_default_str();
  command->add_flag("--resume", options->resume, "continue what is in DIR (always the case; accepted for clarity)");
  command->add_flag("--quiet", options->quiet, "no progress");
  command->callback([options, &result] { sweep(*options, result); });
}

}  // namespace suture
