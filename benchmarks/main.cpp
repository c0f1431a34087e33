// Measures speed and accuracy; prints a table and writes JSON. scripts/benchmark builds and runs it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <fstream>
#include <optional>

#include "groups.hpp"

namespace suture::benchmark {

namespace {

constexpr const char* group_names[] = {"kernels", "rate", "packing", "closures", "ladders", "cases", "grid", "rivals", "events", "large"};

void measure(const Settings& settings, Report& report) {
  if (settings.wants("kernels")) measure_kernels(settings, report);
  if (settings.wants("rate")) measure_rates(settings, report);
  if (settings.wants("packing")) measure_packing(settings, report);
  if (settings.wants("large")) measure_large_tissues(settings, report);
  if (settings.wants("rivals")) measure_rivals(settings, report);
  if (settings.wants("events")) measure_rivals_with_events(settings, report);
  if (settings.wants("grid")) measure_tolerance_grid(settings, report);
  const bool smooth = settings.wants("ladders") || settings.wants("cases");
  if (!smooth && !settings.wants("closures")) return;
  const Packed wounded = wounded_tissue(settings.smoke);
  if (settings.wants("closures")) measure_closures(settings, report, wounded);
  if (settings.wants("ladders")) measure_ladders(settings, report, wounded);
  if (settings.wants("cases")) measure_cases(settings, report, wounded);
}

}  // namespace

}  // namespace suture::benchmark

int main(int argc, char** argv) {
  using namespace suture::benchmark;
  CLI::App program{"suture_benchmark: how fast, and how accurate"};
  Settings settings;
  std::string json = "benchmark.json", command_line;
  program.add_option("--repeats", settings.repeats, "medians over so many")->check(CLI::Range(1, 1000))->capture_default_str();
  program.add_flag("--long", settings.long_runs, "whole closures, full horizons, largest tissues");
  program.add_flag("--smoke", settings.smoke, "everything once, on the smallest problems");
  program.add_option("--groups", settings.groups, "kernels, rate, packing, closures, ladders, cases, grid, rivals, events, large [all]")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(group_names), std::end(group_names))));
  program.add_option("--json", json, "file for the results")->capture_default_str();
  CLI11_PARSE(program, argc, argv);
  if (settings.smoke) settings.repeats = 1;
  for (int k = 0; k < argc; ++k) command_line += fmt::format("{}{}", k == 0 ? "" : " ", argv[k]);
  Report report;
  int status = 0;
  try {
    measure(settings, report);
  } catch (const std::exception& error) {
    fmt::print(stderr, "suture_benchmark: error: {}\n", error.what());
    status = 3;
  }
  std::ofstream(json) << report.json(command_line);  // what was measured before an error, too
  return status;
}
