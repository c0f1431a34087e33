// The program: parses the command line, runs one subcommand, turns errors into one line and an exit code.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iostream>

#include "commands.hpp"
#include "suture/errors.hpp"
#include "suture/io/nearest_name.hpp"
#include "suture/version.hpp"

namespace suture {

void add_set_option(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option("--set", overrides, "override a key of the configuration: section.key=value (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->take_all();
}

namespace {

using AddCommand = void (*)(CLI::App&, CommandResult&);
constexpr AddCommand commands[] = {
    add_check_command,
    add_config_command,
    add_converge_command,
    add_export_command,
    add_forces_command,
    add_recover_command,
    add_render_command,
    add_run_command,
    add_status_command,
    add_sweep_command,
    add_validate_command,
    add_view_command,
};

bool looks_like_override(const std::string& argument) {
  const auto equals = argument.find('=');
  return equals != std::string::npos && equals > 0 &&
         std::all_of(argument.begin(), argument.begin() + static_cast<std::ptrdiff_t>(equals),
                     [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.'; });
}

// "--set a=1 b=2" means "--set a=1 --set b=2"; the parser alone could not tell "b=2" from a file name.
std::vector<std::string> with_repeated_set(const std::vector<std::string>& arguments) {
  std::vector<std::string> result;
  bool after_override = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (after_override && looks_like_override(arguments[i])) result.emplace_back("--set");
    result.push_back(arguments[i]);
    if (arguments[i] == "--set" && i + 1 < arguments.size())
      result.push_back(arguments[++i]), after_override = true;
    else if (!looks_like_override(arguments[i]))
      after_override = false;
  }
  return result;
}

void refuse_unknown_command(const CLI::App& program, const std::vector<std::string>& arguments) {
  if (arguments.empty()) return;
  if (arguments.front().starts_with('-')) {
    if (program.get_option_no_throw(arguments.front()) == nullptr)
      throw InputError(
          fmt::format("command line: found the unknown option '{}' (see suture --help)", arguments.front()));
    return;
  }
  std::vector<std::string> names;
  std::string list;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == arguments.front()) return;
    names.push_back(command->get_name());
    list += fmt::format("{}{}", list.empty() ? "" : ", ", command->get_name());
  }
  throw InputError(fmt::format("command line: found the unknown command '{}', allowed one of {}{}", arguments.front(),
                               list, suggestion(arguments.front(), names)));
}

ExitCode run_program(std::vector<std::string> arguments) {
  CLI::App program{"suture: closure of epithelial wounds by deformable cells", "suture"};
  CommandResult result;
  program.set_version_flag("--version", [] { return version_text(); });
  program.require_subcommand(1);
  for (const AddCommand add_command : commands) add_command(program, result);
  refuse_unknown_command(program, arguments);
  arguments = with_repeated_set(arguments);
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes vectors back to front
  try {
    program.parse(std::move(arguments));
  } catch (const CLI::Success& request) {  // --help, --version
    program.exit(request);
  } catch (const CLI::RuntimeError& verdict) {  // a command that has said itself what is wrong
    return static_cast<ExitCode>(verdict.get_exit_code());
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("command line: {} (see suture --help)", error.what()));
  }
  return result.exit_code;
}

int report(std::string message, ExitCode code) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << "suture: error: " << message << std::endl;
  return static_cast<int>(code);
}

}  // namespace

}  // namespace suture

int main(int argc, char** argv) {
  using namespace suture;
  try {
    return static_cast<int>(run_program({argv + 1, argv + argc}));
  } catch (const InputError& error) {
    return report(error.what(), ExitCode::bad_input);
  } catch (const std::exception& error) {  // NumericalError, FileError, out of memory
    return report(error.what(), ExitCode::failed);
  }
}
