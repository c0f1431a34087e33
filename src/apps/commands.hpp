// The subcommands of the program. Each lives in its own <name>_command.cpp, adds itself to the parser and does its work
// in a callback; it reports bad input and failures by throwing (errors.hpp). To add one: declare it here, write the
// file, list it in CMakeLists.txt and in the table of main.cpp.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace suture {

/// What the program returns. Anything else is thrown: InputError gives bad_input, other errors give failed.
enum class ExitCode { done = 0, bad_input = 2, failed = 3, stopped_early = 75 };

/// Left at `done` by a command that finished.
struct CommandResult {
  ExitCode exit_code = ExitCode::done;
};

/// Adds `--set section.key=value ...`; the texts are the overrides of read_config. `overrides` must live as long as the
/// parser (use a shared_ptr captured by the callback).
void add_set_option(CLI::App& command, std::vector<std::string>& overrides);

void add_check_command(CLI::App& program, CommandResult& result);
void add_config_command(CLI::App& program, CommandResult& result);
void add_converge_command(CLI::App& program, CommandResult& result);
void add_export_command(CLI::App& program, CommandResult& result);
void add_forces_command(CLI::App& program, CommandResult& result);
void add_recover_command(CLI::App& program, CommandResult& result);
void add_render_command(CLI::App& program, CommandResult& result);
void add_run_command(CLI::App& program, CommandResult& result);
void add_status_command(CLI::App& program, CommandResult& result);
void add_sweep_command(CLI::App& program, CommandResult& result);
void add_validate_command(CLI::App& program, CommandResult& result);
void add_view_command(CLI::App& program, CommandResult& result);

}  // namespace suture
