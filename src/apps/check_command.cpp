// suture check: is this file what it claims to be?
#include <fmt/format.h>

#include <filesystem>
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

/// Names of a run's files.
constexpr const char* run_files[] = {"run.h5",       "run.journal", "checkpoint", "checkpoint.previous",
                                     "summary.json", "wound.csv",   "cell.csv"};

/// The verdict on one file; an unreadable one is bad input.
bool check_and_print(const std::string& file) {
  const FileReport report = check_file(file);
  if (report.verdict == FileVerdict::unreadable)
    throw InputError(fmt::format("{}: not a readable suture file: {}", file, report.problems.front()));
  std::cout << text_of(file, report);
  return report.verdict == FileVerdict::valid;
}

bool check_folder(const std::filesystem::path& folder) {
  bool valid = true, any = false;
  for (const char* name : run_files)
    if (std::filesystem::exists(folder / name)) any = true, valid &= check_and_print((folder / name).string());
  if (!any) throw InputError(fmt::format("{}: holds no file of a run", folder.string()));
  return valid;
}

}  // namespace

void add_check_command(CLI::App& program, CommandResult& result) {
  const auto file = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("check", "verify an output file, or all in a folder");
  command->add_option("FILE", *file, "file, or folder of a run")->required();
  command->callback([file, &result] {
    if (!(std::filesystem::is_directory(*file) ? check_folder(*file) : check_and_print(*file)))
      result.exit_code = ExitCode::failed;
  });
}

}  // namespace suture
