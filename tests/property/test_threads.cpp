// A tissue large enough to be divided: the same bits for every number of threads, and the numbers of an undivided one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <set>

#include "neighbors/contact_list.hpp"
#include "ode/padded_tissue.hpp"
#include "support/integration.hpp"
#include "support/invariance.hpp"
#include "support/random_tissue.hpp"
#include "threads/ranges.hpp"

using namespace suture;
using namespace suture::test;

namespace {

constexpr double contact_distance = 0.12, skin = 0.05;

/// Numbered row by row: most blocks touch the next ones only.
TissueState tissue_of_rows() {
  return random_tissue(5, {.rows = 38, .columns = 38, .minimum_vertices = 20, .maximum_vertices = 28, .spacing = 1.0, .roughness = 0.03});
}

/// Numbered at random: any two parts touch, and in cells that touch a third one.
TissueState large_tissue() {
  const TissueState rows = tissue_of_rows();
  std::vector<int> cells(rows.tissue.cell_count());
  std::iota(cells.begin(), cells.end(), 0);
  std::shuffle(cells.begin(), cells.end(), std::mt19937(1));
  return reordered(rows, cells).state;
}

TissueOdeOptions options(int threads) {
  TissueOdeOptions o = ode_options(contact_law(contact_distance), SpringLaw::quadratic, true, skin);
  o.threads = threads;
  return o;
}

/// Everything the integrators ask for, at two states that need different lists.
std::vector<double> everything(const TissueState& state, int threads) {
  TissueOde ode(state.tissue, 0, options(threads), {});
  const auto n = static_cast<std::size_t>(ode.position_count());
  std::vector<double> all, out(state.values.size()), part(n), product(n), memory(state.values.size() - n), y = state.values;
  const auto step = random_direction(state, 1, 0.03);
  for (int there = 0; there < 2; ++there) {
    REQUIRE(ode.rate(0.0, y, out) == Evaluation::ok);
    all.insert(all.end(), out.begin(), out.end());
    ode.begin_implicit_step(0.0, 0.05, y);
    REQUIRE(ode.residual(std::span(y).first(n), part) == Evaluation::ok);
    ode.linearise();
    ode.product(part, product);
    ode.set_up_preconditioner();
    all.insert(all.end(), product.begin(), product.end());
    ode.precondition(part, product);
    ode.recover_memory(std::span(y).first(n), memory);
    for (const auto* v : {&part, &product, &memory}) all.insert(all.end(), v->begin(), v->end());
    for (std::size_t k = 0; k < n; ++k) y[k] += step[k];
  }
  CHECK(ode.list_rebuilds() == 2);
  return all;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void load(PaddedTissue& padded, const TissueState& state) {
  kernels::best().shell_gradient(padded.shell, {state.view().x.data(), state.view().y.data(), state.view().rest_length.data()});
}

}  // namespace

TEST_CASE("rate, product and preconditioner have the same bits for every number of threads", "[property][threads]") {
  const TissueState state = large_tissue();
  REQUIRE(state.tissue.vertex_count() > divided_from_vertices);
  const std::vector<double> expected = everything(state, 1);
  CHECK(largest(expected) > 1.0);
  for (const int threads : {2, 3, 5})
    for (int again = 0; again < 2; ++again) {
      CAPTURE(threads);
      CHECK(same_bits(everything(state, threads), expected));
    }
}

TEST_CASE("integrations have the same bits for every number of threads", "[property][threads]") {
  const TissueState state = large_tissue();
  for (const Method method : {Method::rkc2, Method::cvode}) {
    std::vector<double> expected;
    for (const int threads : {1, 2, 3, 5}) {
      TissueOde ode(state.tissue, 0, options(threads), {});
      Statistics counts;
      const std::vector<double> y = integrate(ode, suture::test::with_tolerance(method, 1e-3), 0.0, state.values, 0.02, &counts);
      if (threads == 1) expected = y;
      CAPTURE(threads, static_cast<int>(method));
      CHECK(counts.steps >= 3);
      CHECK(same_bits(y, expected));
      CHECK(largest_difference(y, state.values) > 1e-3);
    }
  }
}

TEST_CASE("a divided tissue has the forces of an undivided one", "[property][threads]") {
  const TissueState state = large_tissue();
  TissueOde ode(state.tissue, 0, options(2), {});
  std::vector<double> gradient(state.layout().size()), whole(state.tissue.vertex_count());
  REQUIRE(ode.gradient(0.0, state.view(), MutableStateView(state.layout(), gradient)) == Evaluation::ok);
  PaddedTissue padded(state.tissue, SpringLaw::quadratic);
  load(padded, state);
  ContactList list(1.3 * contact_distance, contact_distance, skin);
  list.build(padded.shell, kernels::best());
  REQUIRE(list.schedule().blocks() == 1);
  REQUIRE(list.schedule().pairs().empty());
  const ContactList::Entries& all = list.entries(0);
  const double e = 0.5, s = contact_distance, l1 = 0.1, l2 = 0.3, outer = 2.0 * e * l1 / (l2 - l1);
  const kernels::ContactScalars contact{s * s * (1 + l2) * (1 + l2), s * s * (1 + l1) * (1 + l1), -2 * e / s, 2 * e / (s * s),
                                        outer * (1 + l2) / s, -outer / (s * s), s * s};
  const ContactParameters law = contact_law(contact_distance);
  REQUIRE((law.energy == e && law.adhesion == l1 && law.range == l2));
  WindowGroups groups;
  groups.assign(all.windows);
  kernels::best().contact_gradient(padded.shell, contact, groups.data(), groups.windows(), all.self_pairs.data(), all.self_pairs.size());
  std::vector<double> whole_y(whole.size());
  padded.pack_gradient(whole, whole_y);
  CHECK(largest_difference(whole, std::span(gradient).first(whole.size())) < 1e-12 * largest(whole));
  CHECK(largest(whole) > 1.0);
}

TEST_CASE("lists are as old as the cells they are about", "[property][threads]") {
  const TissueState state = large_tissue();
  std::vector<double> moved(state.values), before(moved.size()), by_old_list(moved.size()), by_new_list(moved.size());
  std::mt19937 engine(4);
  const StateLayout layout = state.layout();
  for (int cell = 300; cell < 340; ++cell) {  // as far as a list bears, the others stay where they are
    const double angle = 1e-9 * static_cast<double>(engine());
    for (int v = state.tissue.first_vertex(cell); v < state.tissue.end_vertex(cell); ++v)
      moved[layout.x(v)] += 0.499 * skin * std::cos(angle), moved[layout.y(v)] += 0.499 * skin * std::sin(angle);
  }
  TissueOde worn(state.tissue, 0, options(2), {}), fresh(state.tissue, 0, options(2), {});
  REQUIRE(worn.rate(0.0, state.values, before) == Evaluation::ok);
  REQUIRE(worn.rate(0.0, moved, by_old_list) == Evaluation::ok);
  REQUIRE(worn.list_rebuilds() == 1);
  REQUIRE(fresh.rate(0.0, moved, by_new_list) == Evaluation::ok);
  CHECK(largest_difference(by_old_list, by_new_list) < 1e-11 * largest(by_new_list));
  CHECK(largest_difference(by_old_list, before) > 1e-3 * largest(by_new_list));
}

TEST_CASE("a list that turns out to be worn when most blocks are finished leaves no trace", "[property][threads]") {
  const TissueState state = tissue_of_rows();
  const StateLayout layout = state.layout();
  std::vector<double> moved(state.values);
  for (int v = state.tissue.first_vertex(1400); v < state.tissue.end_vertex(1400); ++v) moved[layout.x(v)] += 0.55 * skin;
  const std::span<const double> before = state.values, after = moved;
  const auto positions = static_cast<std::size_t>(layout.positions());
  std::vector<double> expected(moved.size()), found(moved.size()), expected_residual(positions), residual(positions);
  TissueOde fresh(state.tissue, 0, options(1), {});
  REQUIRE(fresh.rate(0.0, after, expected) == Evaluation::ok);
  fresh.begin_implicit_step(0.0, 0.05, before);
  REQUIRE(fresh.residual(after.first(positions), expected_residual) == Evaluation::ok);
  for (const int threads : {1, 2, 5}) {
    CAPTURE(threads);
    TissueOde ode(state.tissue, 0, options(threads), {});
    REQUIRE(ode.rate(0.0, before, found) == Evaluation::ok);
    REQUIRE(ode.rate(0.0, after, found) == Evaluation::ok);
    CHECK(ode.list_rebuilds() == 2);
    CHECK(same_bits(found, expected));
    REQUIRE(ode.rate(0.0, before, found) == Evaluation::ok);
    ode.begin_implicit_step(0.0, 0.05, before);
    REQUIRE(ode.residual(after.first(positions), residual) == Evaluation::ok);
    CHECK(ode.list_rebuilds() == 4);
    CHECK(same_bits(residual, expected_residual));
  }
}

TEST_CASE("every block is completed once, by the last list that is about it", "[property][threads]") {
  for (const bool shuffled : {false, true}) {
    const TissueState state = shuffled ? large_tissue() : tissue_of_rows();
    PaddedTissue padded(state.tissue, SpringLaw::quadratic);
    load(padded, state);
    ContactList list(1.3 * contact_distance, contact_distance, skin, 20);
    for (int build = 0; build < 2; ++build) list.build(padded.shell, kernels::best());
    const int blocks = list.schedule().blocks();
    std::vector<int> completed(blocks), late(blocks);
    int early = 0;  // before anything is done between parts
    list.schedule().for_each_list(WorkerPool::alone(), [&](int k) {
      for (const int block : list.entries(k).blocks) late[block] += completed[block];
      for (const int block : list.entries(k).completes) ++completed[block], early += k < blocks;
    });
    CHECK(std::all_of(completed.begin(), completed.end(), [](int times) { return times == 1; }));
    CHECK(std::all_of(late.begin(), late.end(), [](int times) { return times == 0; }));
    if (!shuffled) CHECK(early > blocks / 4);
  }
}

TEST_CASE("divided lists hold the whole contact list, each what it may touch", "[property][threads]") {
  const TissueState state = large_tissue();
  PaddedTissue padded(state.tissue, SpringLaw::quadratic);
  load(padded, state);
  constexpr int cells_per_block = 20;
  ContactList whole(1.3 * contact_distance, contact_distance, skin), divided(1.3 * contact_distance, contact_distance, skin, cells_per_block);
  whole.build(padded.shell, kernels::best());
  divided.build(padded.shell, kernels::best());
  const ContactSchedule& schedule = divided.schedule();
  REQUIRE(schedule.blocks() == (state.tissue.cell_count() + cells_per_block - 1) / cells_per_block);
  REQUIRE(schedule.parts() >= 8);
  const auto block_of = [&](int slot) { return state.tissue.cell_of(padded.vertex(slot)) / cells_per_block; };
  const auto part_of = [&](int block) {
    int part = 0;
    while (schedule.blocks_of(part).end <= static_cast<std::size_t>(block)) ++part;
    return part;
  };
  const auto key = [](const kernels::Window& w) { return std::array<int, 4>{w.p, w.q, w.segments, w.band}; };
  std::vector<std::array<int, 4>> expected, found;
  for (const kernels::Window& w : whole.entries(0).windows) expected.push_back(key(w));
  std::vector<int> worked_on;
  std::size_t pairs = 0, between = 0;
  int wrong = 0;
  const auto take = [&](int list, int first, int second) {
    worked_on.push_back(list);
    pairs += divided.entries(list).self_pairs.size();
    for (const kernels::Window& w : divided.entries(list).windows) {
      found.push_back(key(w));
      const int p = block_of(w.p), q = block_of(w.q);
      if (list < schedule.blocks())
        wrong += std::max(p, q) != list || part_of(p) != part_of(q);
      else
        wrong += part_of(p) != first || part_of(q) != second, ++between;
    }
  };
  for (int b = 0; b < schedule.blocks(); ++b) take(b, 0, 0);
  std::set<std::pair<int, int>> taken;  // (round, part)
  for (const auto& [first, second, round] : schedule.pairs()) {
    wrong += !taken.insert({round, first}).second || !taken.insert({round, second}).second;
    take(schedule.list_between(first, second), first, second);
    take(schedule.list_between(second, first), second, first);
  }
  std::vector<int> order;
  schedule.for_each_list(WorkerPool::alone(), [&](int list) { order.push_back(list); });
  CHECK(order == worked_on);
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  CHECK(expected.size() > 10000);
  CHECK(between > 1000);
  CHECK(found == expected);
  CHECK(pairs == whole.entries(0).self_pairs.size());
  CHECK(wrong == 0);
}
