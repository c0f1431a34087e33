// The matrix and the preconditioner of the implicit step against the assembled Hessian of the terms.
#include <Eigen/SparseCholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "support/implicit_step.hpp"
#include "support/integration.hpp"
#include "support/newton_terms.hpp"
#include "support/random_tissue.hpp"
#include "suture/physics/contact_geometry.hpp"
#include "suture/physics/purse_string_chain.hpp"
#include "suture/physics/purse_string_operations.hpp"
#include "suture/physics/purse_string_tethers.hpp"
#include "suture/physics/rest_length_flow.hpp"
#include "suture/physics/term_sum.hpp"

using namespace suture;
using namespace suture::test;

namespace {

constexpr double contact_distance = 0.25;

/// Stretched membranes, so that no compressed segment's curvature is left out of the Newton matrix.
TissueState stretched(std::uint64_t seed, RandomTissueOptions options = {.spacing = 0.95, .roughness = 0.1}) {
  TissueState state = random_tissue(seed, options);
  for (double& l0 : state.mutable_view().rest_length) l0 *= 0.6;
  return state;
}

}  // namespace

TEST_CASE("preconditioned conjugate gradients solve what a sparse factorisation of the terms solves", "[unit]") {
  for (const SpringLaw law : {SpringLaw::quadratic, SpringLaw::relative})
    for (const std::uint64_t seed : {1, 2}) {
      const TissueState state = stretched(seed);
      Config config;
      config.membrane.law = law;
      config.contact = contact_law(contact_distance);
      const double gamma = 0.001;
      TissueOde ode(state.tissue, 0, ode_options(config.contact, law, false), {});
      linearise(ode, state, gamma);
      ode.set_up_preconditioner();
      const int n = ode.position_count();
      Eigen::SparseMatrix<double> matrix =
          gamma * assemble_hessian(newton_terms(state.tissue, config), 0.0, state.view());
      Eigen::SparseMatrix<double> identity(n, n);
      identity.setIdentity();
      matrix += identity;
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> direct(matrix);
      REQUIRE(direct.info() == Eigen::Success);
      const Eigen::VectorXd b = wave(n), expected = direct.solve(b);
      Eigen::VectorXd product(n);
      ode.product(span(expected), span(product));
      int iterations = 0;
      const Eigen::VectorXd x = conjugate_gradients(ode, b, iterations);
      CAPTURE(seed, iterations);
      CHECK(relative_difference(expected, b) > 0.005);
      CHECK(relative_difference(product, b) < 1e-11);
      CHECK(relative_difference(x, expected) < 1e-10);
      CHECK(iterations < 60);
    }
}

TEST_CASE("setting the preconditioner up disturbs no product, and a product no set-up, though they share room", "[unit]") {
  for (const auto& [fewest, most] : {std::pair{3, 9}, {24, 40}}) {
    const TissueState state = stretched(3, {.minimum_vertices = fewest, .maximum_vertices = most, .spacing = 0.95, .roughness = 0.1});
    TissueOde ode(state.tissue, 0, ode_options(contact_law(contact_distance), SpringLaw::quadratic, false), {});
    linearise(ode, state, 0.01);
    const int n = ode.position_count();
    const Eigen::VectorXd v = wave(n);
    Eigen::VectorXd product(n), applied(n), again(n);
    ode.product(span(v), span(product));
    ode.set_up_preconditioner();
    ode.precondition(span(v), span(applied));
    ode.product(span(v), span(again));
    CHECK(again == product);
    ode.set_up_preconditioner();
    ode.precondition(span(v), span(again));
    CHECK(again == applied);
    CHECK(product != v);
    CHECK(applied != v);
  }
}

TEST_CASE("the Newton matrix has no contact that is subtracted at a concave corner", "[unit]") {
  Config config;
  config.contact = contact_law(contact_distance);
  const double reach = contact_distance * (1.0 + config.contact.adhesion);
  int subtracted = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    const TissueState state = stretched(seed, {.spacing = 0.95, .roughness = 0.3});
    const StateView view = state.view();
    for (int v = 0; v < state.tissue.vertex_count(); ++v)
      for (int cell = 0; cell < state.tissue.cell_count(); ++cell) {
        if (cell == state.tissue.cell_of(v)) continue;
        const int first = state.tissue.first_vertex(cell), n = state.tissue.vertex_count(cell);
        for_each_contact_feature({view.x[v], view.y[v]}, view.x.subspan(first, n), view.y.subspan(first, n), [](int, double) {},
                                 [&](int k, int weight) {
                                   subtracted += weight < 0 && std::hypot(view.x[v] - view.x[first + k], view.y[v] - view.y[first + k]) < reach;
                                 });
      }
    const double gamma = 0.01;
    TissueOde ode(state.tissue, 0, ode_options(config.contact, SpringLaw::quadratic, false), {});
    linearise(ode, state, gamma);
    const Eigen::VectorXd v = wave(ode.position_count());
    const Eigen::VectorXd expected = v + gamma * (assemble_hessian(newton_terms(state.tissue, config), 0.0, view) * v);
    Eigen::VectorXd product(v.size());
    ode.product(span(v), span(product));
    CAPTURE(seed);
    CHECK(relative_difference(product, expected) < 1e-11);
  }
  CHECK(subtracted > 10);
}

TEST_CASE("eliminating rest lengths scales the membrane stiffness by (tau + gamma xi)/(tau + gamma)", "[unit]") {
  for (const double tau : {0.01, 3.0, 1e5}) {
    const double memory = 0.3, gamma = 0.004;
    TissueState state = stretched(3);
    std::vector<CellMaterial> plastic, reduced;
    for (int c = 0; c < state.tissue.cell_count(); ++c) {
      CellMaterial material = state.tissue.material(c);
      material.tau = tau, material.memory = memory;
      plastic.push_back(material);
      material.membrane_stiffness *= (tau + gamma * memory) / (tau + gamma);
      reduced.push_back(material);
    }
    state.tissue = state.tissue.with_materials(plastic);
    std::vector<double> reference;
    for (const double l0 : state.view().rest_length) reference.push_back(0.9 * l0);
    TissueOde ode(state.tissue, 0, ode_options(contact_law(contact_distance)), {}, reference);
    linearise(ode, state, gamma);

    // The reduced cell: the same tension from the smaller stiffness.
    TissueState equivalent = state;
    equivalent.tissue = state.tissue.with_materials(reduced);
    std::vector<double> recovered(state.tissue.vertex_count());
    ode.recover_memory(std::span(state.values).first(ode.position_count()), recovered);
    for (int v = 0; v < state.tissue.vertex_count(); ++v) {
      const int next = state.tissue.next(v);
      const double l = std::hypot(state.view().x[next] - state.view().x[v], state.view().y[next] - state.view().y[v]);
      const double l0 = implicit_rest_length(state.view().rest_length[v], gamma, l, reference[v], tau, memory);
      CHECK(recovered[v] == Approx(l0).epsilon(1e-13));
      equivalent.mutable_view().rest_length[v] = l - (l - l0) * (tau + gamma) / (tau + gamma * memory);
    }
    Config config;
    config.contact = contact_law(contact_distance);
    const Eigen::SparseMatrix<double> hessian =
        assemble_hessian(newton_terms(equivalent.tissue, config), 0.0, equivalent.view());
    const Eigen::VectorXd v = wave(ode.position_count()), expected = v + gamma * (hessian * v);
    Eigen::VectorXd product(v.size());
    ode.product(span(v), span(product));
    CAPTURE(tau);
    CHECK(relative_difference(expected, v) > 0.01);
    CHECK(relative_difference(product, expected) < 1e-11);
  }
}

TEST_CASE("the preconditioner of cells without neighbours is the exact inverse", "[unit]") {
  // Rows of cells far apart, of every size: nothing is left out, whatever shares a batch.
  for (const int least : {3, 4, 5, 6, 20}) {
    TissueState state = stretched(7, {.rows = 2,
                                      .columns = 5,
                                      .minimum_vertices = least,
                                      .maximum_vertices = least + 4,
                                      .spacing = 2.0,
                                      .roughness = 0.05});
    TissueOde ode(state.tissue, 0, ode_options(contact_law(0.1, 0.1, false)), {});
    for (const double gamma : {0.001, 0.05}) {
      linearise(ode, state, gamma);
      ode.set_up_preconditioner();
      const Eigen::VectorXd b = wave(ode.position_count());
      Eigen::VectorXd z(b.size()), back(b.size());
      ode.precondition(span(b), span(z));
      ode.product(span(z), span(back));
      CAPTURE(least, gamma);
      CHECK(relative_difference(z, b) > 0.003);
      CHECK(relative_difference(back, b) < 1e-6);  // factors in single precision; measured: 1.3e-7
    }
  }
}

TEST_CASE("the chain of the purse string is factored exactly, every time anew and for every ring size", "[unit]") {
  TissueState state = stretched(
      2, {.rows = 1, .columns = 2, .minimum_vertices = 40, .maximum_vertices = 40, .spacing = 2.0, .roughness = 0.05});
  for (const int size : {3, 4, 5, 6, 7, 12, 13}) {
    // A ring of its own, not tethered: points beyond the cells.
    PurseString string;
    string.minimum_rest_length = 1e-3;
    TissueState ringed = state;
    std::vector<double> x(state.view().x.begin(), state.view().x.end()),
        y(state.view().y.begin(), state.view().y.end());
    for (int j = 0; j < size; ++j) {
      string.vertex.push_back(j);
      string.spring.push_back({0.2, 0.0, 0.3});
      string.mode.push_back(TetherMode::attached);
      x.push_back(std::cos(6.28 * j / size) + 0.05 * std::sin(9.0 * j));
      y.push_back(std::sin(6.28 * j / size));
    }
    ringed.purse_string = string;
    ringed.values = x;
    ringed.values.insert(ringed.values.end(), y.begin(), y.end());
    ringed.values.insert(ringed.values.end(), state.view().rest_length.begin(), state.view().rest_length.end());
    auto chain = std::make_shared<PurseStringChain>(state.tissue, string, PurseStringParameters{});
    TissueOde ode(state.tissue, size, ode_options(contact_law(0.05, 0.1, false)), {chain});
    for (const double gamma : {0.05, 0.002, 0.3}) {  // a set-up must not see what the one before left behind
      linearise(ode, ringed, gamma);
      ode.set_up_preconditioner();
      const Eigen::VectorXd b = wave(ode.position_count());
      Eigen::VectorXd z(b.size()), back(b.size());
      ode.precondition(span(b), span(z));
      ode.product(span(z), span(back));
      CAPTURE(size, gamma);
      const int vertices = state.tissue.vertex_count();  // of cells, which are in single precision
      for (const int first : {vertices, 2 * vertices + size})
        CHECK(relative_difference(back.segment(first, size), b.segment(first, size)) < 1e-9);
      CHECK(relative_difference(back, b) < 1e-6);
    }
  }
}

TEST_CASE("a matrix can be linearised again after it was used", "[unit]") {
  const TissueState state = stretched(4);
  TissueOde ode(state.tissue, 0, ode_options(contact_law(contact_distance)), {});
  linearise(ode, state, 0.01);
  const Eigen::VectorXd v = wave(ode.position_count());
  Eigen::VectorXd first(v.size()), second(v.size());
  ode.product(span(v), span(first));
  ode.linearise();
  ode.product(span(v), span(second));
  CHECK(first.norm() > 1.0);
  CHECK((first - second).norm() == 0.0);
}

TEST_CASE("a step that would turn a collapsed segment round is shortened there and nowhere else", "[unit]") {
  TissueState state = random_tissue(3);
  const int i = state.tissue.first_vertex(1) + 2, j = i + 1, points = state.layout().points();
  auto view = state.mutable_view();
  view.x[j] = view.x[i] + 1e-3, view.y[j] = view.y[i];
  TissueOde ode(state.tissue, 0, ode_options(contact_law(contact_distance)), {});
  const std::span<const double> q(state.values.data(), ode.position_count());
  std::vector<double> step(q.size(), 1e-3);  // all the same way: nothing changes its length
  step[i] += 4e-3, step[points + j] -= 3e-3;
  auto limited = step;
  ode.limit_step(q, limited);
  const double rx = limited[j] - limited[i], ry = limited[points + j] - limited[points + i];
  CHECK(std::hypot(rx, ry) == Approx(0.5e-3));
  CHECK(rx * (step[points + j] - step[points + i]) == Approx(ry * (step[j] - step[i])));  // shortened, not turned
  CHECK(limited[i] + limited[j] == Approx(step[i] + step[j]));
  CHECK(limited[points + i] + limited[points + j] == Approx(step[points + i] + step[points + j]));
  for (const int k : {i, j, points + i, points + j}) limited[k] = step[k];
  CHECK(limited == step);
  CHECK(ode.step_limit(q, step) == Approx(0.5e-3 / std::hypot(step[j] - step[i], step[points + j] - step[points + i])));

  auto growing = std::vector<double>(q.size(), 0.0);
  growing[j] = 5e-3;  // six times as long, in the same direction
  const auto as_it_was = growing;
  ode.limit_step(q, growing);
  CHECK(growing == as_it_was);
  CHECK(ode.step_limit(q, growing) == 1.0);
}
