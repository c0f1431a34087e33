// Contacts in symmetric tissues, where vertices lie at right angles to the starts of segments but for rounding: whether a term is
// there and where on its segment it is are decided in two places, which must not disagree.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "neighbors/contact_list.hpp"
#include "ode/padded_tissue.hpp"
#include "suture/physics/contact.hpp"
#include "support/runnable_tables.hpp"
#include "support/wound_tissues.hpp"

using namespace suture;

namespace {

constexpr double s = 0.13, l1 = 0.1, l2 = 0.3, e = 0.5, outer = 2.0 * e * l1 / (l2 - l1);
constexpr kernels::ContactScalars scalars{.cutoff2 = s * s * (1 + l2) * (1 + l2),
                                          .inner2 = s * s * (1 + l1) * (1 + l1),
                                          .inner_a = -2 * e / s,
                                          .inner_b = 2 * e / (s * s),
                                          .outer_a = outer * (1 + l2) / s,
                                          .outer_b = -outer / (s * s),
                                          .self2 = 0.0};

/// x, then y.
std::vector<double> by_kernel(const kernels::Table& table, const TissueState& state) {
  PaddedTissue padded(state.tissue, SpringLaw::quadratic);
  const StateView view = state.view();
  REQUIRE(table.shell_gradient(padded.shell, {view.x.data(), view.y.data(), view.rest_length.data()}));
  ContactList list(std::sqrt(scalars.cutoff2), 0.0, 0.05);
  list.build(padded.shell, table);
  std::fill_n(padded.shell.gradient, 2 * padded.slots(), 0.0);
  table.contact_gradient(padded.shell, scalars, list.entries(0).groups.data(), list.active(0), nullptr, 0);
  const std::size_t n = view.rest_length.size();
  std::vector<double> gradient(2 * n);
  table.fold_gradient(padded.shell, gradient.data(), gradient.data() + n);
  return gradient;
}

std::vector<double> by_term(const TissueState& state) {
  const Contact contact(state.tissue, {.energy = e, .distance = s, .adhesion = l1, .range = l2, .self_contact = false});
  std::vector<double> gradient(state.layout().size(), 0.0);
  contact.add_gradient(0.0, state.view(), MutableStateView(state.layout(), gradient));
  gradient.resize(state.layout().positions());
  return gradient;
}

}  // namespace

TEST_CASE("contacts of straight-sided hexagons have the forces of the term", "[property]") {
  for (const kernels::Table* table : test::runnable_tables())
    for (int points_per_side = 2; points_per_side <= 6; ++points_per_side)
      for (const double gap : {0.09, 0.12, 0.15})
        for (int k = 0; k < 20; ++k) {
          TissueState state = test::tissue_of(test::honeycomb({.rings = 1, .gap = gap, .points_per_side = points_per_side}));
          test::move(state, 0.37 * k, 0.11 * k, -0.07 * k);
          const std::vector<double> found = by_kernel(*table, state), expected = by_term(state);
          double worst = 0.0, largest = 0.0;
          for (std::size_t i = 0; i < found.size(); ++i) {
            worst = std::max(worst, std::abs(found[i] - expected[i]));
            largest = std::max(largest, std::abs(expected[i]));
          }
          CAPTURE(table->name, points_per_side, gap, k);
          REQUIRE(largest > 0.1);
          CHECK(worst < 1e-11 * largest);
        }
}
