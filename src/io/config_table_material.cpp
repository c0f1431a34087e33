// Rows of the configuration table: what the tissue is made of, and its purse string.
#include "config_table.hpp"

namespace suture {

std::vector<ConfigKey<Config>> material_keys() {
  using C = Config;
  return {
      key<&C::tissue, &TissueParameters::seed>("tissue", "seed", pure_number, between(0, 9e18),
                                               "seed of the random packing; the same seed gives the same tissue"),
      key<&C::tissue, &TissueParameters::cells>("tissue", "cells", pure_number, between(1, 1e6),
                                                "number of cells before wounding"),
      key<&C::tissue, &TissueParameters::vertices>("tissue", "vertices", pure_number, between(3, 1e4),
                                                   "number of membrane vertices of each cell"),
      key<&C::tissue, &TissueParameters::shape_parameter>(
          "tissue", "shape_parameter", pure_number, {1.0, infinite, true, false},
          "shape parameter p^2/(4 pi a) of a cell at rest; 1 is a regular polygon"),
      key<&C::membrane, &MembraneParameters::law>("membrane", "law", pure_number, anything,
                                                  "elastic law of the membrane segments"),
      key<&C::membrane, &MembraneParameters::stiffness>("membrane", "stiffness", energy, non_negative,
                                                        "stretching stiffness k_l of the membrane segments"),
      key<&C::area, &AreaParameters::stiffness>(
          "area", "stiffness", modulus, non_negative,
          "stiffness k_a of a cell against changes of its area; as a quantity, its bulk modulus B = k_a f_adh/a0",
          {.unset = {}, .aliases = {{"bulk_modulus", true}, {"B", true}}}),
      key<&C::bending, &BendingParameters::stiffness>("bending", "stiffness", energy, non_negative,
                                                      "bending stiffness k_b at the membrane vertices"),
      key<&C::contact, &ContactParameters::energy>("contact", "energy", energy, positive,
                                                   "energy scale e of the contact between two cells"),
      key<&C::contact, &ContactParameters::distance>(
          "contact", "distance", length, positive, "contact distance s, the full membrane width",
          {.unset = "the mean initial rest length l0(0) of the segments", .aliases = {}}),
      key<&C::contact, &ContactParameters::adhesion>(
          "contact", "adhesion", in_contact_distances, between(0, 1),
          "depth l1 of the adhesive well; 0 is pure repulsion; must be smaller than range"),
      key<&C::contact, &ContactParameters::range>("contact", "range", in_contact_distances, above_zero_to(10),
                                                  "range l2 beyond s at which contact forces end"),
      key<&C::contact, &ContactParameters::self_contact>(
          "contact", "self_contact", pure_number, anything,
          "vertices of one cell repel each other, so that a membrane cannot cross itself"),
      key<&C::plasticity, &PlasticityParameters::tau>(
          "plasticity", "tau", time, positive_or_infinite,
          "time in which a membrane segment's rest length follows its length; inf is an elastic cell"),
      key<&C::plasticity, &PlasticityParameters::memory>(
          "plasticity", "memory", pure_number, non_negative,
          "shape-memory ratio xi: pull of the rest lengths back to those before wounding; 0 is none"),
  };
}

std::vector<ConfigKey<Config>> purse_string_keys() {
  using C = Config;
  using P = PurseStringParameters;
  constexpr std::string_view section = "purse_string";
  return {
      key<&C::purse_string, &P::enabled>(section, "enabled", pure_number, anything,
                                         "false: the wound is left without a purse string"),
      key<&C::purse_string, &P::stiffness>(section, "stiffness", energy, non_negative,
                                           "stiffness k_ps of the chain springs"),
      key<&C::purse_string, &P::law>(section, "law", pure_number, anything,
                                     "elastic law of the chain springs; relative needs minimum_rest_length > 0"),
      key<&C::purse_string, &P::constriction_rate>(section, "constriction_rate", speed, non_negative,
                                                   "rate omega at which the whole string's rest length shortens"),
      key<&C::purse_string, &P::minimum_rest_length>(section, "minimum_rest_length", in_contact_distances,
                                                     between(0, 1), "floor lambda_min of a chain spring's rest length"),
      key<&C::purse_string, &P::tether_stiffness>(section, "tether_stiffness", energy, non_negative,
                                                  "stiffness k_p of the tethers between string and membrane"),
      key<&C::purse_string, &P::tether_law>(section, "tether_law", pure_number, anything, "force law of the tethers"),
      key<&C::purse_string, &P::yield_length>(section, "yield_length", in_contact_distances, positive,
                                              "length l_y at which a tether breaks for good"),
      key<&C::purse_string, &P::capture>(section, "capture", pure_number, anything,
                                         "cell vertices that become exposed to the wound join the string"),
      key<&C::purse_string, &P::crevice_depth>(section, "crevice_depth", pure_number, between(0, 10),
                                               "vertices the string follows each cell into a crevice, beyond the exposed ones"),
      key<&C::purse_string, &P::capture_law>(section, "capture_law", pure_number, anything,
                                             "what a captured vertex does to the chain spring it splits"),
      key<&C::purse_string, &P::capture_search>(section, "capture_search", pure_number, anything,
                                                "which vertices are captured and where they join the string"),
      key<&C::purse_string, &P::search_steps>(section, "search_steps", pure_number, between(1, largest_integer),
                                              "integrator steps between the flood fills of capture_search = \"published\""),
      key<&C::purse_string, &P::capture_steps>(section, "capture_steps", pure_number, between(1, largest_integer),
                                               "integrator steps after which the vertices it found are offered to the string"),
      key<&C::purse_string, &P::gap_law>(section, "gap_law", pure_number, anything,
                                         "rest length of the spring that closes the gap when neighbouring tethers break together"),
      key<&C::purse_string, &P::event_handling>(section, "event_handling", pure_number, anything,
                                                "when breaking and capture of tethers are processed"),
      key<&C::purse_string, &P::event_interval>(section, "event_interval", time, positive,
                                                "spacing of the event grid; located: how long after its tether broke a vertex is captured again, at the earliest"),
      key<&C::purse_string, &P::storm_rate>(section, "storm_rate", pure_number, positive,
                                            "tethers that break or change their mode per unit of time sqrt(a0)/omega, in this or the last unit, beyond which event_handling \"auto\" turns to the grid"),
  };
}

}  // namespace suture
