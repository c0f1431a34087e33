// Rows of the configuration table: what is done to the tissue.
#include "config_table.hpp"

namespace suture {

namespace {

void add_packing_keys(std::vector<ConfigKey<Config>>& rows) {
  using C = Config;
  using P = PackingParameters;
  const auto add = [&rows](ConfigKey<Config> row) { rows.push_back(std::move(row)); };
  constexpr std::string_view section = "packing";
  add(key<&C::packing, &P::initial_fraction>(section, "initial_fraction", pure_number, above_zero_to(1.2),
                                             "packing fraction at which the cells are placed"));
  add(key<&C::packing, &P::final_fraction>(section, "final_fraction", pure_number, above_zero_to(1.2),
                                           "packing fraction to which they are compressed"));
  add(key<&C::packing, &P::increment>(section, "increment", pure_number, above_zero_to(0.1),
                                      "packing fraction per compression step"));
  add(key<&C::packing, &P::adhesion>(section, "adhesion", in_contact_distances, between(0, 1),
                                     "depth l1 of the adhesive well while compressing"));
  add(key<&C::packing, &P::area_stiffness>(section, "area_stiffness", modulus, non_negative, "k_a while compressing"));
  add(key<&C::packing, &P::bending_stiffness>(section, "bending_stiffness", energy, non_negative,
                                              "k_b while compressing"));
  add(key<&C::packing, &P::wall_energy>(section, "wall_energy", energy, positive, "energy scale of the circular wall"));
  add(key<&C::packing, &P::wall_range>(section, "wall_range", in_contact_distances, positive,
                                       "range sigma of the wall"));
  add(key<&C::packing, &P::shape_noise>(section, "shape_noise", pure_number, between(0, 0.2),
                                        "random relative displacement of the corners of the first polygons"));
  add(key<&C::packing, &P::step_tolerance>(section, "step_tolerance", force, positive,
                                           "largest force component left before the next compression step"));
  add(key<&C::packing, &P::force_tolerance>(section, "force_tolerance", force, positive,
                                            "largest force component of the finished packing; one that runs out of iterations below step_tolerance is "
                                            "accepted, and the log says so"));
  add(key<&C::packing, &P::maximum_iterations>(section, "maximum_iterations", pure_number,
                                               between(1, largest_integer), "FIRE iterations allowed per minimisation"));
  add(key<&C::packing, &P::attempts>(section, "attempts", pure_number, between(1, 1000),
                                     "packings tried, each from its own random numbers, until one is accepted"));
}

void add_wound_keys(std::vector<ConfigKey<Config>>& rows) {
  using C = Config;
  const auto add = [&rows](ConfigKey<Config> row) { rows.push_back(std::move(row)); };
  add(key<&C::anneal, &AnnealParameters::temperature>("anneal", "temperature", energy, non_negative,
                                                      "temperature of the constant-energy motion"));
  add(key<&C::anneal, &AnnealParameters::duration>("anneal", "duration", time, non_negative,
                                                   "duration of the constant-energy motion"));
  add(key<&C::anneal, &AnnealParameters::time_step>("anneal", "time_step", time, positive,
                                                    "velocity-Verlet step of the constant-energy motion"));
  add(key<&C::anneal, &AnnealParameters::relaxation_time>("anneal", "relaxation_time", time, non_negative,
                                                          "overdamped motion after the constant-energy motion"));
  add(key<&C::anneal, &AnnealParameters::tolerance>(
      "anneal", "tolerance", in_rest_lengths, positive,
      "of the overdamped motions before closure, which are always solved by cvode so that every integrator.method starts "
      "from the same wound"));
  add(key<&C::wound, &WoundParameters::cells>("wound", "cells", pure_number, between(1, 1e6),
                                              "number of cells ablated, those nearest the tissue centre"));
  add(key<&C::wound, &WoundParameters::relaxation_time>("wound", "relaxation_time", time, non_negative,
                                                        "elastic overdamped motion before the purse string forms"));
  add(key<&C::wound, &WoundParameters::minimum_area>("wound", "minimum_area", area, non_negative,
                                                     "a packing whose wound is smaller is refused"));
  add(key<&C::wound, &WoundParameters::maximum_area>("wound", "maximum_area", area, positive_or_infinite,
                                                     "a packing whose wound is larger is refused"));
  add(key<&C::wound, &WoundParameters::maximum_hole>("wound", "maximum_hole", area, positive_or_infinite,
                                                     "a packing with a larger hole between its cells is refused"));
}

void add_single_cell_keys(std::vector<ConfigKey<Config>>& rows) {
  using C = Config;
  const auto add = [&rows](ConfigKey<Config> row) { rows.push_back(std::move(row)); };
  add(key<&C::compression, &CompressionParameters::gap>("compression", "gap", {Dimension::none, "cell diameters"},
                                                        above_zero_to(1),
                                                        "distance between the plates while the cell is compressed"));
  add(key<&C::compression, &CompressionParameters::closing_time>(
      "compression", "closing_time", time, positive, "time in which the plates close, the first part of the duration"));
  add(key<&C::compression, &CompressionParameters::duration>("compression", "duration", time, positive,
                                                             "time T for which the cell is compressed"));
  add(key<&C::compression, &CompressionParameters::recovery>("compression", "recovery", time, non_negative,
                                                             "time for which the cell is observed after release"));
  add(key<&C::compression, &CompressionParameters::plate_energy>("compression", "plate_energy", energy, positive,
                                                                 "energy scale of the plates"));
  add(key<&C::dipole, &DipoleParameters::force>("dipole", "force", force, non_negative,
                                                "force on each vertex, away from the centre of mass"));
  add(key<&C::dipole, &DipoleParameters::duration>("dipole", "duration", time, positive,
                                                   "time T for which the dipole acts"));
}

}  // namespace

std::vector<ConfigKey<Config>> protocol_keys() {
  std::vector<ConfigKey<Config>> rows;
  add_packing_keys(rows);
  add_wound_keys(rows);
  add_single_cell_keys(rows);
  return rows;
}

}  // namespace suture
