// suture recover: a readable run.h5 and wound.csv from whatever a killed run has left.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "commands.hpp"
#include "suture/io/recover.hpp"

namespace suture {

void add_recover_command(CLI::App& program, CommandResult&) {
  const auto directory = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("recover", "make run.h5 and wound.csv from the journal of an unfinished run");
  command->add_option("DIR", *directory, "folder of the run")->required();
  command->callback([directory] { std::cout << recover_run(*directory); });
}

}  // namespace suture
