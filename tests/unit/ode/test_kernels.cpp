// The three compilations of the kernels agree to rounding, and the vector operations with plain loops.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "neighbors/contact_list.hpp"
#include "ode/cell_preconditioner.hpp"
#include "ode/padded_tissue.hpp"
#include "support/integration.hpp"
#include "support/random_tissue.hpp"
#include "support/runnable_tables.hpp"

using namespace suture;
using namespace suture::test;

namespace {

kernels::ContactScalars scalars(double s, double l1, double l2) {
  const double e = 0.5, outer = 2.0 * e * l1 / (l2 - l1);
  return {.cutoff2 = s * s * (1 + l2) * (1 + l2),
          .inner2 = s * s * (1 + l1) * (1 + l1),
          .inner_a = -2 * e / s,
          .inner_b = 2 * e / (s * s),
          .outer_a = outer * (1 + l2) / s,
          .outer_b = -outer / (s * s),
          .self2 = s * s};
}

/// What one table computes from one tissue, as long lists of numbers.
struct Computed {
  std::vector<double> in_double, in_single;
};
Computed everything(const kernels::Table& table, const TissueState& state, SpringLaw law) {
  PaddedTissue padded(state.tissue, law);
  const int n = state.tissue.vertex_count();
  padded.unpack(state.view().rest_length, padded.shell.rest_a);
  std::fill_n(padded.shell.rest_b, padded.slots(), 0.2);
  REQUIRE(table.shell_gradient(padded.shell, {state.view().x.data(), state.view().y.data()}));
  ContactList list(0.26, 0.2, 0.1);
  list.build(padded.shell, table);
  const kernels::ContactScalars contact = scalars(0.2, 0.1, 0.3);
  const std::vector<kernels::Window>& windows = list.entries(0).windows;
  const std::vector<kernels::SelfPair>& pairs = list.entries(0).self_pairs;
  WindowGroups groups;
  groups.assign(windows);
  table.contact_gradient(padded.shell, contact, groups.data(), groups.windows(), pairs.data(), pairs.size());
  std::vector<double> result{static_cast<double>(windows.size())};
  std::vector<double> part(n);
  const auto keep = [&](double* padded_values) {
    padded.fold_and_pack(padded_values, part);
    result.insert(result.end(), part.begin(), part.end());
  };
  std::vector<double> gx(n), gy(n);
  table.fold_gradient(padded.shell, gx.data(), gy.data());
  result.insert(result.end(), gx.begin(), gx.end());
  result.insert(result.end(), gy.begin(), gy.end());
  table.shell_linearise(padded.shell, padded.hessian);
  std::vector<kernels::ContactFactor> factors(16 * windows.size() + pairs.size());
  const std::size_t count =
      table.contact_linearise(padded.shell, contact, groups.data(), groups.windows(), pairs.data(), pairs.size(), factors.data());
  REQUIRE(count > 50);
  result.push_back(static_cast<double>(count));
  std::vector<double> direction(n);
  for (int k = 0; k < n; ++k) direction[k] = std::sin(1.7 * k);
  padded.unpack(direction, padded.hessian.vx);
  for (int k = 0; k < n; ++k) direction[k] = std::cos(2.1 * k);
  padded.unpack(direction, padded.hessian.vy);
  table.shell_product(padded.shell, padded.hessian);
  table.contact_product(factors.data(), count, padded.hessian.vx, padded.hessian.vy, padded.hessian.ox,
                        padded.hessian.oy);
  keep(padded.hessian.ox);
  keep(padded.hessian.oy);
  CellPreconditioner preconditioner(state.tissue, padded, 0, table);
  WorkerPool alone(1);
  ContactFactors contacts;
  contacts.linearise(list, padded.shell, contact, table, alone);
  preconditioner.set_up(0.003, contacts, {}, alone);
  std::vector<double> solution(2 * n), rhs(2 * n);
  for (int k = 0; k < 2 * n; ++k) rhs[k] = std::sin(1.3 * k);
  preconditioner.apply(rhs, solution, alone);
  return {result, solution};
}

}  // namespace

TEST_CASE("baseline, AVX2 and AVX-512 kernels agree to rounding", "[unit]") {
  const auto tables = runnable_tables();
  for (const SpringLaw law : {SpringLaw::quadratic, SpringLaw::relative})
    for (const std::uint64_t seed : {1, 2, 3}) {
      const TissueState state = random_tissue(seed, {.minimum_vertices = 3, .maximum_vertices = 40});
      const auto expected = everything(kernels::baseline, state, law);
      REQUIRE(largest(expected.in_double) > 1.0);
      REQUIRE(largest(expected.in_single) > 0.1);
      for (const kernels::Table* table : tables) {
        const auto got = everything(*table, state, law);
        CAPTURE(table->name, seed);
        REQUIRE(got.in_double.size() == expected.in_double.size());
        CHECK(largest_difference(got.in_double, expected.in_double) < 1e-12 * largest(expected.in_double));
        CHECK(largest_difference(got.in_single, expected.in_single) < 1e-6 * largest(expected.in_single));
      }
    }
}

TEST_CASE("the vector operations equal plain loops", "[unit]") {
  constexpr std::size_t most = 88;
  alignas(64) static double x[most], y[most], w[most], z[most], z2[most], expected[most];
  for (std::size_t k = 0; k < most; ++k) x[k] = std::sin(k + 1.0), y[k] = std::cos(3.0 * k), w[k] = 1.0 + 0.1 * k;
  const std::size_t n = GENERATE(88, 81, 47, 5);
  for (const kernels::Table* table : runnable_tables()) {
    CAPTURE(table->name, n);
    std::fill(z, z + most, 7.0);
    std::fill(z2, z2 + most, 7.0);
    double squares = 0.0, dot = 0.0;
    for (std::size_t k = 0; k < n; ++k) squares += x[k] * w[k] * x[k] * w[k], dot += x[k] * y[k];
    CHECK(table->weighted_square_sum(n, x, w) == Approx(squares).epsilon(1e-14));
    CHECK(table->dot(n, x, y) == Approx(dot).epsilon(1e-13));
    table->linear_sum(n, 2.5, x, -0.3, y, z);
    for (std::size_t k = 0; k < n; ++k) expected[k] = 2.5 * x[k] - 0.3 * y[k];
    CHECK(largest_difference({z, n}, {expected, n}) < 1e-15 * 4);
    const double c[6] = {1.0, -2.0, 0.7, 0.4, -0.1, 3.0};
    const double* sources[6] = {x, y, w, y, x, w};
    for (int count = 1; count <= 6; ++count) {
      table->linear_combination(n, count, c, sources, z);
      for (std::size_t k = 0; k < n; ++k) {
        expected[k] = 0.0;
        for (int j = 0; j < count; ++j) expected[k] += c[j] * sources[j][k];
      }
      CAPTURE(count);
      CHECK(largest_difference({z, n}, {expected, n}) < 1e-13);
    }
    const double* terms[2] = {y, w};
    double* results[2] = {z, z2};
    table->scale_add_multi(n, 2, c, x, terms, results);
    for (std::size_t k = 0; k < n; ++k) expected[k] = x[k] + y[k];
    CHECK(largest_difference({z, n}, {expected, n}) < 1e-15 * 4);
    for (std::size_t k = 0; k < n; ++k) expected[k] = -2.0 * x[k] + w[k];
    CHECK(largest_difference({z2, n}, {expected, n}) < 1e-14);
    for (std::size_t k = 0; k < n; ++k) expected[k] = x[k] - w[k];
    CHECK(table->subtract_and_dot(n, x, w, y, z) == Approx(std::inner_product(y, y + n, expected, 0.0)).epsilon(1e-13));
    CHECK(largest_difference({z, n}, {expected, n}) == 0.0);
    y[n - 1] = -3.0;  // the largest is negative, the last one
    for (std::size_t k = 0; k < n; ++k) expected[k] = x[k] + y[k];
    CHECK(table->add_and_largest(n, x, y, z) == 3.0);
    CHECK(largest_difference({z, n}, {expected, n}) == 0.0);
    std::copy_n(w, n, z);
    std::copy_n(x, n, z2);
    table->add_scaled_twice(n, 0.5, x, z, y, z2);
    for (std::size_t k = 0; k < n; ++k) expected[k] = w[k] + 0.5 * x[k];
    CHECK(largest_difference({z, n}, {expected, n}) < 1e-14);
    for (std::size_t k = 0; k < n; ++k) expected[k] = x[k] + 0.5 * y[k];
    CHECK(largest_difference({z2, n}, {expected, n}) < 1e-14);
    std::copy_n(y, n, z);
    CHECK(table->implicit_residual(n, x, w, 0.3, z));
    for (std::size_t k = 0; k < n; ++k) expected[k] = x[k] - w[k] + 0.3 * y[k];
    CHECK(largest_difference({z, n}, {expected, n}) < 1e-14);
    for (const std::size_t bad : {std::size_t{2}, n - 1}) {
      std::copy_n(y, n, z);
      z[bad] = std::nan("");
      CHECK_FALSE(table->implicit_residual(n, x, w, 0.3, z));
    }
    for (const double* array : {z, z2}) CHECK(std::count(array + n, array + most, 7.0) == static_cast<std::ptrdiff_t>(most - n));
  }
}

TEST_CASE("the diagonal blocks of contacts are those of their product", "[unit]") {
  constexpr int slots = 6;
  std::vector<kernels::ContactFactor> factors;
  for (int k = 0; k < 9; ++k) {
    const double angle = 0.9 * k;
    factors.push_back({k * std::cos(angle), k * std::sin(angle), 0.1 * k, k % 3, 3 + k % 2});
  }
  for (const kernels::Table* table : runnable_tables()) {
    alignas(64) double blocks[4 * slots] = {};
    table->contact_diagonal(factors.data(), factors.size(), blocks);
    for (int slot = 0; slot < slots; ++slot) {
      double vx[slots] = {}, vy[slots] = {}, ox[slots] = {}, oy[slots] = {}, px[slots] = {}, py[slots] = {};
      vx[slot] = 1.0;
      table->contact_product(factors.data(), factors.size(), vx, vy, ox, oy);
      vx[slot] = 0.0, vy[slot] = 1.0;
      table->contact_product(factors.data(), factors.size(), vx, vy, px, py);
      CAPTURE(table->name, slot);
      CHECK(blocks[4 * slot] == Approx(ox[slot]).margin(1e-14));
      CHECK(blocks[4 * slot + 1] == Approx(px[slot]).margin(1e-14));
      CHECK(blocks[4 * slot + 2] == Approx(py[slot]).margin(1e-14));
    }
  }
}
