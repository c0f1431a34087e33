// The assembled and factored matrix against the matrix-free product, conjugate gradients and whole steps.
#include <catch2/catch.hpp>
#include <map>
#include <memory>

#include "integrate/minimising_newton.hpp"
#include "support/implicit_step.hpp"
#include "support/integration.hpp"
#include "support/random_tissue.hpp"
#include "suture/physics/purse_string_chain.hpp"
#include "suture/physics/purse_string_tethers.hpp"
#include "unit/purse_string/ring_fixture.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Cells with a stretched string on them; chain and tethers are extra terms.
struct Ringed {
  explicit Ringed(SpringLaw law) : parameters(ring_parameters(law)), state(with_string(parameters)) {
    for (int j = 0; j < state.purse_string.size(); ++j) stretch_tether(state, j, 0.02 + 0.01 * j, 0.5 * j);
    state.time += 0.2;
    for (double& l0 : state.mutable_view().rest_length) l0 *= 0.8;
  }
  std::unique_ptr<TissueOde> ode(LinearSolver solver) const {
    std::vector<std::shared_ptr<const EnergyTerm>> extra{
        std::make_shared<PurseStringChain>(state.tissue, state.purse_string, parameters),
        std::make_shared<PurseStringTethers>(state.tissue, state.purse_string, parameters, contact_distance)};
    auto made = std::make_unique<TissueOde>(state.tissue, state.purse_string.size(),
                                            ode_options(contact_law(2.0 * contact_distance)), std::move(extra));
    made->choose_linear_solver(solver);
    return made;
  }
  PurseStringParameters parameters;
  TissueState state;
};

/// |A P^-1 b - b| / |b|.
double inverse_error(TissueOde& ode) {
  ode.set_up_preconditioner();
  const Eigen::VectorXd b = wave(ode.position_count());
  Eigen::VectorXd z(b.size()), back(b.size());
  ode.precondition(span(b), span(z));
  ode.product(span(z), span(back));
  return relative_difference(back, b);
}

}  // namespace

TEST_CASE("the assembled matrix is the one that products apply", "[unit]") {
  for (const SpringLaw law : {SpringLaw::quadratic, SpringLaw::relative})
    for (const std::uint64_t seed : {1, 2, 3}) {  // cells that overlap each other and themselves
      const TissueState state = random_tissue(seed, {.minimum_vertices = 3, .maximum_vertices = 40, .strain = 0.05});
      TissueOde ode(state.tissue, 0, ode_options(contact_law(0.2), law, true), {});
      linearise(ode, state, 1e-3);
      CAPTURE(static_cast<int>(law), seed);
      CHECK(inverse_error(ode) > 1e-4);
      ode.choose_linear_solver(LinearSolver::sparse_direct);
      CHECK(inverse_error(ode) < 1e-11);
    }
}

TEST_CASE("the assembled matrix has the purse string's chain and tethers", "[unit]") {
  for (const SpringLaw law : {SpringLaw::quadratic, SpringLaw::relative}) {
    const Ringed ringed(law);
    const auto ode = ringed.ode(LinearSolver::sparse_direct);
    linearise(*ode, ringed.state, 1e-3);
    CHECK(inverse_error(*ode) < 1e-11);
    ode->choose_linear_solver(LinearSolver::structured);
    CHECK(inverse_error(*ode) > 1e-4);
  }
}

TEST_CASE("conjugate gradients and the direct solve find the same Newton step", "[unit]") {
  const Ringed ringed(SpringLaw::relative);
  const auto structured = ringed.ode(LinearSolver::structured), direct = ringed.ode(LinearSolver::sparse_direct);
  for (const double gamma : {1e-3, 5e-3}) {
    const Eigen::VectorXd b = wave(structured->position_count());
    Eigen::VectorXd exact(b.size());
    int many = 0, few = 0;
    linearise(*structured, ringed.state, gamma);
    structured->set_up_preconditioner();
    const Eigen::VectorXd x = conjugate_gradients(*structured, b, many);
    linearise(*direct, ringed.state, gamma);
    direct->set_up_preconditioner();
    direct->precondition(span(b), span(exact));
    const Eigen::VectorXd y = conjugate_gradients(*direct, b, few);
    CAPTURE(gamma, many, few);
    CHECK(relative_difference(x, exact) < 1e-10);
    CHECK(relative_difference(y, exact) < 1e-10);
    CHECK(few <= 2);
    CHECK(many > 3);
  }
}

TEST_CASE("a matrix that is not definite is left to the structured preconditioner", "[unit]") {
  const TissueState state = random_tissue(1);
  TissueOde ode(state.tissue, 0, ode_options(contact_law(0.2)), {});
  linearise(ode, state, 10.0);
  const Eigen::VectorXd b = wave(ode.position_count());
  std::map<LinearSolver, Eigen::VectorXd> solution;
  for (const LinearSolver solver : {LinearSolver::structured, LinearSolver::sparse_direct}) {
    ode.choose_linear_solver(solver);
    ode.set_up_preconditioner();
    solution[solver] = b;
    ode.precondition(span(b), span(solution[solver]));
    CHECK(b.dot(solution[solver]) > 0.0);
  }
  CHECK(solution[LinearSolver::structured] == solution[LinearSolver::sparse_direct]);
}

TEST_CASE("a minimising solve takes one linear iteration per Newton iteration with the direct solver", "[unit]") {
  const Ringed ringed(SpringLaw::quadratic);
  std::vector<std::vector<double>> found;
  for (const LinearSolver solver : {LinearSolver::structured, LinearSolver::sparse_direct}) {
    const auto ode = ringed.ode(solver);
    const double gamma = 5e-3;
    ode->begin_implicit_step(ringed.state.time, gamma, ringed.state.values);
    const bool exact = solver == LinearSolver::sparse_direct;
    MinimisingNewton newton(*ode, {.weight = 1e9, .maximum_iterations = 60, .forcing = 1e-6, .maximum_secants = 0, .always_set_up = exact});
    std::vector<double> q(ringed.state.values.begin(), ringed.state.values.begin() + ode->position_count());
    REQUIRE(newton.solve(gamma, q, {.tolerance = 1.0, .give_up = 1e15}) == NewtonResult::converged);
    REQUIRE(newton.counts().iterations >= 2);
    if (exact) {
      CHECK(newton.counts().linear_iterations == newton.counts().iterations);
      CHECK(newton.counts().setups == newton.counts().hessians);
    } else {
      CHECK(newton.counts().linear_iterations > 2 * newton.counts().iterations);
    }
    found.push_back(q);
  }
  CHECK(largest_difference(found[0], found[1]) < 1e-8);
}
