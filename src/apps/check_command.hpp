// `suture check FILE`.
#pragma once

namespace CLI {
class App;
}

namespace suture {

/// Adds the subcommand. Its callback prints a verdict and throws CLI::RuntimeError with the exit code 2 (not one of our
/// files, or unreadable) or 3 (invalid content) unless the file is valid.
void add_check_command(CLI::App& app);

}  // namespace suture
