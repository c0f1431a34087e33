#include "suture/physics/term_forces.hpp"

#include <algorithm>

#include "suture/physics/term_sum.hpp"

namespace suture {

namespace {

/// Self-contact is printed as part of contact, as in the reference data.
std::string printed_name(const EnergyTerm& term) {
  return term.name() == "self_contact" ? "contact" : std::string(term.name());
}

}  // namespace

std::vector<TermForces> evaluate_forces(const TissueState& state, const Config& config) {
  const StateLayout layout = state.layout();
  std::vector<TermForces> all;
  for (const auto& term : make_cell_terms(state.tissue, config)) {
    std::vector<double> gradient(layout.size(), 0.0);
    const MutableStateView view(layout, gradient);
    term->add_gradient(state.time, state.view(), view);
    const std::string name = printed_name(*term);
    auto found = std::find_if(all.begin(), all.end(), [&](const TermForces& forces) { return forces.term == name; });
    if (found == all.end())
      found = all.insert(all.end(),
                         {name, 0.0, std::vector<double>(layout.points()), std::vector<double>(layout.points())});
    found->energy += term->energy(state.time, state.view());
    for (int i = 0; i < layout.points(); ++i) {
      found->fx[i] -= view.x[i];
      found->fy[i] -= view.y[i];
    }
  }
  return all;
}

}  // namespace suture
