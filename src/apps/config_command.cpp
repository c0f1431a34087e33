// suture config: prints what the configuration table knows.
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "suture/io/config.hpp"

namespace suture {

namespace {

struct Options {
  bool defaults = false;
  bool reference = false;
  std::string preset = "printed";
  std::string key;
};

}  // namespace

void add_config_command(CLI::App& program, CommandResult&) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("config", "print and explain the configuration keys");
  CLI::Option* defaults =
      command->add_flag("--defaults", options->defaults, "print a commented configuration file of all defaults");
  command->add_option("--preset", options->preset, "defaults of which preset: printed or published_code")
      ->needs(defaults);
  CLI::Option* explain =
      command->add_option("--explain", options->key, "explain one key (area.stiffness) or section (area)");
  CLI::Option* reference = command->add_flag("--reference", options->reference, "print docs/reference/config.md");
  defaults->excludes(explain)->excludes(reference);
  explain->excludes(reference);
  command->callback([options, command] {
    if (options->defaults)
      std::cout << write_config(default_config(options->preset), Comments::full);
    else if (options->reference)
      std::cout << config_reference();
    else if (!options->key.empty())
      std::cout << explain_config_key(options->key);
    else
      std::cout << command->help();
  });
}

}  // namespace suture
