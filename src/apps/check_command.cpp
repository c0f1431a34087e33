// suture check: is this file what it claims to be?
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "commands.hpp"
#include "suture/errors.hpp"
#include "suture/io/trajectory_check.hpp"

namespace suture {

namespace {

std::string text_of(const std::string& file, const FileReport& report) {
  std::string text = fmt::format("{}: {}\n", file, report.verdict == FileVerdict::valid ? "valid" : "INVALID");
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
    if (report.verdict == FileVerdict::unreadable)
      throw InputError(fmt::format("{}: not a readable suture file: {}", *file, report.problems.front()));
    std::cout << text_of(*file, report);
    if (report.verdict == FileVerdict::invalid) result.exit_code = ExitCode::failed;
  });
}

}  // namespace suture
