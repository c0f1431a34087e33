#include "support/term_table.hpp"

#include "support/random_tissue.hpp"
#include "suture/physics/area_elasticity.hpp"
#include "suture/physics/bending_elasticity.hpp"
#include "suture/physics/confinement.hpp"
#include "suture/physics/constant_load.hpp"
#include "suture/physics/contact.hpp"
#include "suture/physics/membrane_elasticity.hpp"
#include "suture/physics/plates.hpp"
#include "suture/physics/self_contact.hpp"

namespace suture::test {

namespace {

TissueState packed(std::uint64_t seed) { return random_tissue(seed); }

/// Cells so rough and finely divided that vertices of one cell come close to each other.
TissueState crumpled(std::uint64_t seed) {
  return random_tissue(seed,
                       {.rows = 1, .columns = 2, .minimum_vertices = 24, .maximum_vertices = 30, .roughness = 0.25});
}

template <class Term>
std::shared_ptr<const EnergyTerm> of_tissue(const TissueState& state) {
  return std::make_shared<Term>(state.tissue);
}

template <SpringLaw law>
std::shared_ptr<const EnergyTerm> membrane(const TissueState& state) {
  return std::make_shared<MembraneElasticity>(state.tissue, law);
}

/// The contact distance is a little more than the default, so that packed cells overlap and repel as well as adhere.
std::shared_ptr<const EnergyTerm> contact(const TissueState& state, double adhesion) {
  return std::make_shared<Contact>(
      state.tissue, ContactParameters{.distance = 1.1 * state.tissue.mean_initial_rest_length(), .adhesion = adhesion});
}

std::shared_ptr<const EnergyTerm> self_contact(const TissueState& state) {
  return std::make_shared<SelfContact>(state.tissue,
                                       ContactParameters{.distance = 2.0 * state.tissue.mean_initial_rest_length()});
}

/// Some vertices inside its range, some beyond the wall, some free.
std::shared_ptr<const EnergyTerm> confinement(const TissueState& state) {
  return std::make_shared<Confinement>(1.2, 0.5, 1.5, 0.4, 2.0, state.tissue.vertex_count());
}

/// The gap is smaller than the tissue: vertices are beyond each plate.
std::shared_ptr<const EnergyTerm> plates(const TissueState& state) {
  return std::make_shared<Plates>(ParallelPlates{.center_y = 0.4, .gap = 1.0, .range = 0.3, .energy = 2.0},
                                  state.tissue.vertex_count());
}

std::shared_ptr<const EnergyTerm> load(const TissueState& state) {
  const int points = state.layout().points();
  return std::make_shared<ConstantLoad>(std::vector<double>(points, 0.3), std::vector<double>(points, -0.7));
}

}  // namespace

const std::vector<TermCase>& term_table() {
  static const std::vector<TermCase> table{
      {"area", true, packed, of_tissue<AreaElasticity>},
      {"membrane, relative", true, packed, membrane<SpringLaw::relative>},
      {"membrane, quadratic", true, packed, membrane<SpringLaw::quadratic>},
      {"bending", true, packed, of_tissue<BendingElasticity>},
      {"contact, adhesive", true, packed, [](const TissueState& state) { return contact(state, 0.1); }},
      {"contact, repulsive", true, packed, [](const TissueState& state) { return contact(state, 0.0); }},
      {"self-contact", true, crumpled, self_contact},
      {"confinement", false, packed, confinement},
      {"plates", false, packed, plates},
      {"constant load", false, packed, load},
  };
  return table;
}

}  // namespace suture::test
