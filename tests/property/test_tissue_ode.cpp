// The vectorised kernels against the readable terms, and the implicit step's matrix against differences.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "suture/ode/tissue_ode.hpp"
#include "suture/physics/area_elasticity.hpp"
#include "suture/physics/bending_elasticity.hpp"
#include "suture/physics/contact.hpp"
#include "suture/physics/membrane_elasticity.hpp"
#include "suture/physics/self_contact.hpp"
#include "support/reference_tissue.hpp"

using namespace suture;

namespace {

TissueOdeOptions ode_options(const Config& config) {
  return {.membrane_law = config.membrane.law, .contact = config.contact, .plastic = true, .skin = 0.13, .threads = 1};
}

std::vector<double> term_gradient(const Config& config, const TissueState& state) {
  const Tissue& tissue = state.tissue;
  const AreaElasticity area(tissue);
  const MembraneElasticity membrane(tissue, config.membrane.law);
  const BendingElasticity bending(tissue);
  const Contact contact(tissue, config.contact);
  const SelfContact self(tissue, config.contact);
  std::vector<double> gradient(state.layout().size(), 0.0);
  for (const EnergyTerm* term : {static_cast<const EnergyTerm*>(&area), static_cast<const EnergyTerm*>(&membrane),
                                 static_cast<const EnergyTerm*>(&bending), static_cast<const EnergyTerm*>(&contact),
                                 static_cast<const EnergyTerm*>(&self)})
    term->add_gradient(0.0, state.view(), MutableStateView(state.layout(), gradient));
  return gradient;
}

double largest(const std::vector<double>& a) {
  double m = 0.0;
  for (const double v : a) m = std::max(m, std::abs(v));
  return m;
}

std::vector<double> random_direction(std::size_t size, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<double> v(size);
  for (double& c : v) c = normal(engine);
  return v;
}

}  // namespace

TEST_CASE("the vectorised gradient equals the sum of the terms", "[property]") {
  for (const SpringLaw law : {SpringLaw::quadratic, SpringLaw::relative})
    for (const double adhesion : {0.1, 0.0}) {
      Config config = test::reference_config(law);
      config.contact.adhesion = adhesion;
      TissueState state = test::reference_state(config);
      TissueOde ode(state.tissue, 0, ode_options(config), {});
      std::vector<double> gradient(state.layout().size());
      // Several displacements: the list is used beyond the configuration it was built for, and rebuilt.
      for (const double displacement : {0.0, 0.01, 0.01, 0.03, 0.03}) {
        const auto step = random_direction(state.values.size(), 7);
        for (int k = 0; k < state.layout().positions(); ++k) state.values[k] += displacement * 0.3 * step[k];
        REQUIRE(ode.gradient(0.0, state.view(), MutableStateView(state.layout(), gradient)) == Evaluation::ok);
        const auto expected = term_gradient(config, state);
        double worst = 0.0;
        for (int k = 0; k < state.layout().positions(); ++k) worst = std::max(worst, std::abs(gradient[k] - expected[k]));
        CAPTURE(adhesion, displacement, largest(expected));
        CHECK(largest(expected) > 1.0);
        CHECK(worst < 1e-12 * largest(expected));
      }
      CHECK(ode.list_rebuilds() >= 2);
    }
}

TEST_CASE("the rate is pure: the same bits for the same state", "[property]") {
  const Config config = test::reference_config();
  TissueState state = test::reference_state(config);
  TissueOde ode(state.tissue, 0, ode_options(config), {});
  std::vector<double> first(state.values.size()), second(state.values.size()), other(state.values.size());
  REQUIRE(ode.rate(0.0, state.values, first) == Evaluation::ok);
  auto moved = state.values;
  for (int k = 0; k < state.layout().positions(); ++k) moved[k] += 0.004 * std::sin(k);
  REQUIRE(ode.rate(1.0, moved, other) == Evaluation::ok);
  REQUIRE(ode.rate(0.0, state.values, second) == Evaluation::ok);
  CHECK(first == second);
  CHECK(first != other);
}

TEST_CASE("the matrix of the implicit step is the derivative of its residual", "[property]") {
  for (const SpringLaw law : {SpringLaw::quadratic, SpringLaw::relative}) {
    Config config = test::reference_config(law);
    // Part of the contacts' second derivatives is left out on purpose (test_implicit_step.cpp has what is kept); nothing else is.
    config.contact.energy = 1e-12;
    TissueState state = test::reference_state(config);
    for (double& l0 : state.mutable_view().rest_length) l0 *= 0.5;  // no segment compressed: nothing is left out
    TissueOde ode(state.tissue, 0, ode_options(config), {});
    const int n = ode.position_count();
    const double gamma = 0.002;
    ode.begin_implicit_step(0.0, gamma, state.values);
    std::vector<double> q(state.values.begin(), state.values.begin() + n), f0(n), f1(n), hv(n), moved(n);
    const auto v = random_direction(n, 3);
    REQUIRE(ode.residual(q, f0) == Evaluation::ok);
    ode.linearise();
    ode.product(v, hv);
    std::vector<double> remainder;
    for (const double h : {2e-6, 1e-6, 5e-7}) {
      for (int k = 0; k < n; ++k) moved[k] = q[k] + h * v[k];
      REQUIRE(ode.residual(moved, f1) == Evaluation::ok);
      double sum = 0.0;
      for (int k = 0; k < n; ++k) sum += std::pow(f1[k] - f0[k] - h * hv[k], 2);
      remainder.push_back(std::sqrt(sum));
    }
    CAPTURE(remainder[0], remainder[1], remainder[2]);
    CHECK(std::log2(remainder[0] / remainder[1]) > 1.8);
    CHECK(std::log2(remainder[1] / remainder[2]) > 1.8);
  }
}

TEST_CASE("the preconditioner is symmetric, definite and a good inverse", "[property]") {
  const Config config = test::reference_config();
  TissueState state = test::reference_state(config);
  TissueOde ode(state.tissue, 0, ode_options(config), {});
  const int n = ode.position_count();
  for (const double gamma : {0.001, 0.1}) {
    ode.begin_implicit_step(0.0, gamma, state.values);
    std::vector<double> q(state.values.begin(), state.values.begin() + n), f(n), pa(n), pb(n), product(n);
    REQUIRE(ode.residual(q, f) == Evaluation::ok);
    ode.linearise();
    ode.set_up_preconditioner();
    const auto a = random_direction(n, 1), b = random_direction(n, 2);
    ode.precondition(a, pa);
    ode.precondition(b, pb);
    double ab = 0, ba = 0, aa = 0;
    for (int k = 0; k < n; ++k) ab += a[k] * pb[k], ba += b[k] * pa[k], aa += a[k] * pa[k];
    CHECK(ab == Approx(ba).epsilon(1e-6));  // applied in single precision; measured: 6e-8
    CHECK(aa > 0.0);
    ode.product(pa, product);  // (I + gamma H) P^-1 a is near a when gamma is small
    double error = 0, norm = 0;
    for (int k = 0; k < n; ++k) error += std::pow(product[k] - a[k], 2), norm += a[k] * a[k];
    CAPTURE(gamma, std::sqrt(error / norm));
    if (gamma < 0.01) CHECK(std::sqrt(error / norm) < 0.1);
  }
}

TEST_CASE("bad states are refused in words", "[unit]") {
  const Config config = test::reference_config();
  const TissueState state = test::reference_state(config);
  TissueOde ode(state.tissue, 0, ode_options(config), {});
  std::vector<double> out(state.values.size());
  auto flat = state.values;  // one segment of zero length
  flat[4] = flat[3];
  flat[state.layout().points() + 4] = flat[state.layout().points() + 3];
  CHECK(ode.rate(0.0, flat, out) == Evaluation::refused);
  CHECK(ode.refusal().find("cell 0, vertex 3") != std::string::npos);
  auto mirrored = state.values;
  for (int k = 0; k < state.layout().points(); ++k) mirrored[k] = -mirrored[k];
  CHECK(ode.rate(0.0, mirrored, out) == Evaluation::refused);
  CHECK(ode.refusal().find("inverted") != std::string::npos);
  auto wild = state.values;
  wild[100] = NAN;
  CHECK(ode.rate(0.0, wild, out) == Evaluation::refused);
}
