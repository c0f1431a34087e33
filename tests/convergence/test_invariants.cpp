// What the integrated motion must keep: it does not know where the origin is, and it only goes downhill.
#include <catch2/catch.hpp>
#include <cmath>

#include "support/integration.hpp"
#include "support/random_tissue.hpp"
#include "suture/physics/term_sum.hpp"

using namespace suture;
using namespace suture::test;

namespace {

constexpr double contact_distance = 0.3;

TissueState packed(std::uint64_t seed) {
  return random_tissue(seed, {.spacing = 0.9, .roughness = 0.1, .strain = 0.1});
}

}  // namespace

TEST_CASE("an integrated tissue does not know where the origin is", "[convergence]") {
  for (const Method method : {Method::cvode, Method::rkc2}) {
    const TissueState state = packed(4);
    TissueState moved = state;
    for (double& x : moved.mutable_view().x) x += 64.0;
    for (double& y : moved.mutable_view().y) y -= 32.0;
    TissueOde here(state.tissue, 0, ode_options(contact_law(contact_distance)), {});
    TissueOde there(state.tissue, 0, ode_options(contact_law(contact_distance)), {});
    const double tolerance = 1e-5;
    const auto y = integrate(here, with_tolerance(method, tolerance), 0.0, state.values, 0.5);
    auto z = integrate(there, with_tolerance(method, tolerance), 0.0, moved.values, 0.5);
    const int points = state.layout().points();
    for (int k = 0; k < points; ++k) z[k] -= 64.0, z[points + k] += 32.0;
    CAPTURE(static_cast<int>(method));
    CHECK(largest_difference(y, state.values) > 0.02);
    CHECK(largest_difference(y, z) < 0.01 * tolerance);
  }
}

TEST_CASE("elastic overdamped motion goes downhill at every step", "[convergence]") {
  for (const SpringLaw law : {SpringLaw::quadratic, SpringLaw::relative})
    for (const Method method : {Method::cvode, Method::rkc2}) {
      const TissueState state = packed(9);
      Config config;
      config.membrane.law = law;
      config.contact = contact_law(contact_distance);
      const TermList terms = make_cell_terms(state.tissue, config);
      const auto energy = [&](std::span<const double> y) {
        double sum = 0.0;
        for (const auto& [name, value] : energy_by_term(terms, 0.0, StateView(state.layout(), y))) sum += value;
        return sum;
      };
      TissueOde ode(state.tissue, 0, ode_options(config.contact, law, false), {});
      const auto integrator = make_integrator(ode, with_tolerance(method, 1e-4), 0.0, state.values);
      const double start = energy(state.values);
      double before = start, worst = 0.0;
      int steps = 0;
      while (integrator->time() < 5.0) {
        integrator->step(5.0);
        const double now = energy(integrator->state());
        worst = std::max(worst, now - before);
        before = now;
        ++steps;
      }
      CAPTURE(static_cast<int>(method), start, before, worst, steps);
      CHECK(steps > 20);
      CHECK(before < start - 0.1);
      CHECK(worst < 1e-6 * (start - before));
    }
}
