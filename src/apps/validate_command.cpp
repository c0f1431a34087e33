// suture validate: reads a configuration as a run would, and says in words and physical units what it describes.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "commands.hpp"
#include "suture/io/config.hpp"
#include "suture/io/units.hpp"

namespace suture {

namespace {

struct Options {
  std::string file;
  std::vector<std::string> overrides;
  bool resolved = false;
};

std::string summary(const std::string& file, const Config& config) {
  const UnitScales scales{config.units};
  const auto both = [&scales](double value, Dimension dimension) {
    return fmt::format("{:.6g} ({})", value, physical_text(value, dimension, scales));
  };
  std::string text = fmt::format("{}: valid\n", file);
  text += fmt::format("  protocol {}, preset {}\n", config_value(config, "run.protocol"), config.preset);
  text += fmt::format("  {} cells of {} vertices, seed {}\n", config.tissue.cells, config.tissue.vertices,
                      config.tissue.seed);
  text += fmt::format("  area stiffness k_a = {}\n", both(config.area.stiffness, Dimension::modulus));
  text += fmt::format("  plastic time tau = {}, shape memory xi = {}\n", both(config.plasticity.tau, Dimension::time),
                      config.plasticity.memory);
  text += fmt::format("  one model unit is {:.4g} um and {:.4g} s\n", scales.length_um(), scales.time_s());
  return text;
}

}  // namespace

void add_validate_command(CLI::App& program, CommandResult&) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("validate", "check a configuration file without running it");
  command->add_option("CONFIG", options->file, "configuration file (TOML)")->required();
  add_set_option(*command, options->overrides);
  command->add_flag("--resolved", options->resolved, "print the complete configuration, defaults filled in");
  command->callback([options] {
    const Config config = read_config(options->file, options->overrides);
    std::cout << (options->resolved ? write_config(config) : summary(options->file, config));
  });
}

}  // namespace suture
