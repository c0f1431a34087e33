// suture check: is this file what it claims to be?
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "commands.hpp"
#include "suture/io/trajectory_check.hpp"

namespace suture {

namespace {

ExitCode exit_code(FileVerdict verdict) {
  switch (verdict) {
    case FileVerdict::valid: return ExitCode::done;
    case FileVerdict::unreadable: return ExitCode::bad_input;
    case FileVerdict::invalid: return ExitCode::failed;
  }
  return ExitCode::failed;
}

std::string text_of(const std::string& file, const FileReport& report) {
  const char* const verdict = report.verdict == FileVerdict::valid        ? "valid"
                              : report.verdict == FileVerdict::unreadable ? "not a readable suture file"
                                                                          : "INVALID";
  std::string text = fmt::format("{}: {}\n", file, verdict);
  if (!report.content.empty()) text += fmt::format("  {}\n", report.content);
  for (const std::string& problem : report.problems) text += fmt::format("  problem: {}\n", problem);
  return text;
}

}  // namespace

void add_check_command(CLI::App& program, CommandResult& result) {
  const auto file = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("check", "verify a run.h5, summary.json or wound.csv");
  command->add_option("FILE", *file, "file to verify")->required();
  command->callback([file, &result] {
    const FileReport report = check_file(*file);
    std::cout << text_of(*file, report);
    result.exit_code = exit_code(report.verdict);
  });
}

}  // namespace suture
