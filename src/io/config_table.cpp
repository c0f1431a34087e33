// The configuration table: sections, [[cell_type]], what the program does, and the assembly of all rows.
#include "config_table.hpp"

#include <array>

namespace suture {

namespace {

constexpr std::array sections{
    SectionDescription{"tissue", "how many cells, and of what shape"},
    SectionDescription{"cell_type", "a group of cells that differs from the rest; may be given several times"},
    SectionDescription{"membrane", "stretching of the cell membranes"},
    SectionDescription{"area", "resistance of the cells to changes of area"},
    SectionDescription{"bending", "resistance of the membranes to bending"},
    SectionDescription{"contact", "repulsion and adhesion between cells"},
    SectionDescription{"plasticity", "flow of the membranes' rest lengths"},
    SectionDescription{"purse_string", "contractile ring at the wound edge"},
    SectionDescription{"packing", "compression of the random cells to a confluent tissue"},
    SectionDescription{"anneal", "thermal motion and relaxation of the packed tissue"},
    SectionDescription{"wound", "ablation of cells, and which packings are accepted"},
    SectionDescription{"compression", "one cell between plates (run.protocol = \"compression\")"},
    SectionDescription{"dipole", "one cell in a force dipole (run.protocol = \"dipole\")"},
    SectionDescription{"run", "what is run, and until when"},
    SectionDescription{"integrator", "how the equations of motion are solved"},
    SectionDescription{"output", "what is written, and how often"},
    SectionDescription{"checkpoint", "what a run leaves behind to be continued from"},
    SectionDescription{"units", "physical scales: what one model unit is"},
};

constexpr std::array presets{
    Choice{"printed", 0, "the printed equations of Ton et al. 2023, integrated accurately"},
    Choice{"published_code", 1, "emulation of the published simulations; for validation of Figs. 3 and 4 only"},
};

ConfigKey<Config> preset_key() {
  ConfigKey<Config> row{{"",
                         "preset",
                         pure_number,
                         anything,
                         "bundle of defaults; keys given explicitly win over it, wherever they stand",
                         {},
                         {},
                         presets},
                        [](Config& config) { return make_slot(config.preset); }};
  return row;
}

template <class Rows>
void append(std::vector<ConfigKey<Config>>& target, Rows&& rows) {
  for (auto& row : rows) target.push_back(std::move(row));
}

}  // namespace

std::vector<ConfigKey<Config>> program_keys() {
  using C = Config;
  using I = IntegratorParameters;
  using P = CheckpointParameters;
  constexpr Measure wall_seconds{Dimension::none, "s of wall time"};
  constexpr Measure area_unit{Dimension::area, "um^2", true};
  constexpr Measure force_unit{Dimension::force, "nN", true};
  constexpr Measure speed_unit{Dimension::speed, "um/s", true};
  return {
      key<&C::run, &RunParameters::protocol>("run", "protocol", pure_number, anything, "the experiment"),
      key<&C::run, &RunParameters::last_stage>("run", "last_stage", pure_number, anything,
                                               "last stage of the wound-closure protocol to be run"),
      key<&C::run, &RunParameters::end_time>("run", "end_time", time, positive,
                                             "longest time after creation of the purse string"),
      key<&C::run, &RunParameters::closed_area>("run", "closed_area", area, positive,
                                                "the wound counts as closed below this area; the published simulations ended at 2 pi (l0(0)/2)^2, which is "
                                                "0.0264 for cells of 30 vertices and rest shape 1.2"),
      key<&C::run, &RunParameters::start_from>(
          "run", "start_from", pure_number, anything,
          "run.h5 of an earlier run whose last complete stage is continued; empty: start anew"),
      key<&C::integrator, &I::method>("integrator", "method", pure_number, anything, "time integrator"),
      key<&C::integrator, &I::tolerance>("integrator", "tolerance", in_rest_lengths, above_zero_to(1),
                                         "error tolerance on vertex positions"),
      key<&C::integrator, &I::rest_length_tolerance>("integrator", "rest_length_tolerance", in_rest_lengths,
                                                     above_zero_to(1), "error tolerance on rest lengths"),
      key<&C::integrator, &I::local_error_fraction>(
          "integrator", "local_error_fraction", pure_number, above_zero_to(1),
          "methods cvode and auto: the estimated error of a step of cvode may be this part of the tolerances; its errors add up "
          "more than those of rkc2, and with one half a tolerance means like errors of a run by both"),
      key<&C::integrator, &I::maximum_order>("integrator", "maximum_order", pure_number, between(1, 5),
                                             "highest order of the BDF and Adams formulas; forces have kinks, and orders above 3 cost more than they bring"),
      key<&C::integrator, &I::keep_history>("integrator", "keep_history", pure_number, anything,
                                            "an event keeps the steps behind it; false: every event starts CVODE afresh"),
      key<&C::integrator, &I::linear_solver>("integrator", "linear_solver", pure_number, anything,
                                             "how methods cvode and auto solve for a Newton step"),
      key<&C::integrator, &I::maximum_step>("integrator", "maximum_step", time, positive_or_infinite,
                                            "longest step of the adaptive methods"),
      key<&C::integrator, &I::time_step>("integrator", "time_step", time, positive, "step of the fixed-step methods",
                                         {.unset = "0.01 l0/sqrt(k_a)", .aliases = {}}),
      key<&C::integrator, &I::vertex_mass>("integrator", "vertex_mass", pure_number, positive,
                                           "mass of a vertex in units of b^2 a0/epsilon, for method verlet only; the motion "
                                           "becomes overdamped as it goes to zero"),
      key<&C::integrator, &I::switch_stages>("integrator", "switch_stages", pure_number, positive,
                                             "method auto: rate evaluations per step of rkc2 from which cvode takes over"),
      key<&C::integrator, &I::skin>("integrator", "skin", in_rest_lengths, above_zero_to(100),
                                    "extra reach of the neighbour lists; changes speed, not results"),
      key<&C::integrator, &I::threads>("integrator", "threads", pure_number, between(0, 1024),
                                       "threads that share the work of one run, 0 for one per core; a tissue of fewer than 32768 "
                                       "vertices (1100 cells of 30) is not divided and uses one. Results do not depend on it"),
      key<&C::output, &OutputParameters::interval>("output", "interval", time, positive,
                                                   "time between samples of the wound"),
      key<&C::output, &OutputParameters::frame_interval>("output", "frame_interval", time, positive,
                                                         "time between stored configurations"),
      key<&C::output, &OutputParameters::adjacency>("output", "adjacency", pure_number, anything,
                                                    "which cells the mean shape and the healed shape are taken of"),
      key<&C::output, &OutputParameters::pictures>("output", "pictures", pure_number, between(0, 1000),
                                                   "number of pictures drawn along the run; 0: none at all, not even of its end"),
      key<&C::checkpoint, &P::interval>(
          "checkpoint", "interval", time, positive_or_infinite,
          "time between checkpoints at times the configuration fixes; the integrator starts afresh at each, and a run "
          "resumed from one is bit-identical; inf: none"),
      key<&C::checkpoint, &P::wall_interval>("checkpoint", "wall_interval", wall_seconds, positive_or_infinite,
                                             "wall time between further checkpoints; inf: none"),
      key<&C::checkpoint, &P::reproducible>(
          "checkpoint", "reproducible", pure_number, anything,
          "save at configured checkpoints only, also when the run is stopped, so that a resumed run is always bit-identical"),
      key<&C::checkpoint, &P::sync_interval>(
          "checkpoint", "sync_interval", wall_seconds, {0.0, infinite, true, true},
          "wall time between flushes of run.journal to the disk; a killed program loses nothing either way, a power failure "
          "at most this much"),
      key<&C::units, &UnitParameters::rest_area_um2>("units", "rest_area", area_unit, positive,
                                                     "rest area a0 of a cell: embryo 25, larval wing disc 16",
                                                     {.unset = {}, .aliases = {{"a0", false}}}),
      key<&C::units, &UnitParameters::unsticking_force_nN>("units", "unsticking_force", force_unit, positive,
                                                           "force f_adh that separates two adhering cells"),
      key<&C::units, &UnitParameters::constriction_rate_um_per_s>("units", "constriction_rate", speed_unit, positive,
                                                                  "constriction rate omega of the purse string"),
  };
}

std::span<const SectionDescription> config_sections() { return sections; }

const std::vector<ConfigKey<Config>>& config_keys() {
  static const auto rows = [] {
    std::vector<ConfigKey<Config>> all{preset_key()};
    append(all, material_keys());
    append(all, purse_string_keys());
    append(all, protocol_keys());
    append(all, program_keys());
    return all;
  }();
  return rows;
}

const std::vector<ConfigKey<CellType>>& cell_type_keys() {
  using T = CellType;
  static const std::vector<ConfigKey<CellType>> rows{
      cell_type_key<&T::name>("name", pure_number, anything, "name of the group, for messages and output"),
      cell_type_key<&T::cells>("cells", pure_number, between(1, 1e6), "number of cells in the group"),
      cell_type_key<&T::vertices>("vertices", pure_number, between(3, 1e4), "vertices of each cell",
                                  {"tissue.vertices", {}}),
      cell_type_key<&T::rest_area>("rest_area", area, positive, "rest area of each cell", {"a0", {}}),
      cell_type_key<&T::shape_parameter>("shape_parameter", pure_number, {1.0, infinite, true, false},
                                         "shape parameter at rest", {"tissue.shape_parameter", {}}),
      cell_type_key<&T::area_stiffness>("area_stiffness", modulus, non_negative, "area stiffness k_a",
                                        {"area.stiffness", {{"bulk_modulus", true}, {"B", true}}}),
      cell_type_key<&T::membrane_stiffness>("membrane_stiffness", energy, non_negative, "membrane stiffness k_l",
                                            {"membrane.stiffness", {}}),
      cell_type_key<&T::bending_stiffness>("bending_stiffness", energy, non_negative, "bending stiffness k_b",
                                           {"bending.stiffness", {}}),
      cell_type_key<&T::tau>("tau", time, positive_or_infinite, "plastic relaxation time", {"plasticity.tau", {}}),
      cell_type_key<&T::memory>("memory", pure_number, non_negative, "shape-memory ratio xi",
                                {"plasticity.memory", {}}),
  };
  return rows;
}

}  // namespace suture
