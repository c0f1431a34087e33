// suture forces: the force and energy of every term on one configuration.
#include <memory>

#include "commands.hpp"
#include "suture/io/config.hpp"
#include "suture/io/state_csv.hpp"

namespace suture {

namespace {

struct Options {
  std::string state;
  std::vector<std::string> overrides;
  std::string out;
};

}  // namespace

void add_forces_command(CLI::App& program, CommandResult&) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("forces", "evaluate every term on a configuration");
  command->add_option("STATE.csv", options->state, "columns cell,vertex,x,y,l0, in model units")->required();
  add_set_option(*command, options->overrides);
  command->add_option("--out", options->out, "forces; the energies go to OUT_energy.csv")
      ->type_name("OUT.csv")
      ->required();
  command->callback([options] {
    const Config config = parse_config("", "command line", options->overrides);
    const TissueState state = make_state(read_state_csv(options->state), config);
    const std::vector<TermForces> forces = evaluate_forces(state, config);
    write_forces_csv(options->out, state, forces);
    write_energy_csv(energy_csv_path(options->out), forces);
  });
}

}  // namespace suture
