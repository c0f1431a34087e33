#include "apps/check_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "suture/io/trajectory_check.hpp"

namespace suture {
namespace {

int exit_code(FileVerdict verdict) {
  switch (verdict) {
    case FileVerdict::valid: return 0;
    case FileVerdict::unreadable: return 2;
    case FileVerdict::invalid: return 3;
  }
  return 3;
}

void check_and_print(const std::string& path) {
  const FileReport report = check_file(path);
  const char* const verdict = report.verdict == FileVerdict::valid        ? "valid"
                              : report.verdict == FileVerdict::unreadable ? "not a readable suture file"
                                                                          : "INVALID";
  fmt::print("{}: {}{}{}\n", path, verdict, report.content.empty() ? "" : "; ", report.content);
  for (const std::string& problem : report.problems) fmt::print("  {}\n", problem);
  if (const int code = exit_code(report.verdict); code != 0) throw CLI::RuntimeError(code);
}

}  // namespace

void add_check_command(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("check", "Verify a run.h5, summary.json or wound.csv");
  const auto path = std::make_shared<std::string>();
  command->add_option("file", *path, "File to verify")->required();
  command->callback([path] { check_and_print(*path); });
}

}  // namespace suture
