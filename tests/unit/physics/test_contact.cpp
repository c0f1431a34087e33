#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "support/invariance.hpp"
#include "support/random_tissue.hpp"
#include "suture/errors.hpp"
#include "suture/physics/contact.hpp"
#include "suture/physics/contact_geometry.hpp"
#include "suture/physics/self_contact.hpp"

using namespace suture;
using namespace suture::test;

namespace {

/// Cells with the given outlines; every rest length 1.
TissueState cells(const std::vector<std::vector<Point>>& outlines) {
  std::vector<int> counts;
  TissueState state;
  for (const auto& outline : outlines) counts.push_back(static_cast<int>(outline.size()));
  for (const auto& outline : outlines)
    for (const Point& p : outline) state.values.push_back(p.x);
  const std::size_t points = state.values.size();
  for (const auto& outline : outlines)
    for (const Point& p : outline) state.values.push_back(p.y);
  state.values.resize(3 * points, 1.0);
  state.tissue = Tissue(counts, std::vector<CellMaterial>(outlines.size()), std::vector<double>(points, 1.0));
  return state;
}

const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

double contact_energy(const TissueState& state, const ContactParameters& parameters) {
  return Contact(state.tissue, parameters).energy(0.0, state.view());
}

}  // namespace

TEST_CASE("a vertex above a segment pushes it down with lever arms and no friction", "[unit]") {
  const TissueState state = cells({{{0, -4}, {4, -4}, {4, 0}, {0, 0}}, {{1, 0.5}, {2, 3}, {0, 3}}});
  const Contact contact(state.tissue, {.energy = 0.5, .distance = 1.0, .adhesion = 0.0});
  const ContactLaw& law = contact.law();
  CHECK(contact.energy(0.0, state.view()) == Approx(law.value(0.5)));
  const std::vector<Point> gradient = point_gradient(contact, state);
  CHECK(gradient[4].y == Approx(law.first_derivative(0.5)));          // the vertex
  CHECK(gradient[2].y == Approx(-0.25 * law.first_derivative(0.5)));  // the far end of the segment
  CHECK(gradient[3].y == Approx(-0.75 * law.first_derivative(0.5)));  // the near end
  for (const Point& g : gradient) CHECK(g.x == 0.0);
}

TEST_CASE("distant cells do not touch", "[unit]") {
  std::vector<Point> far = square;
  for (Point& p : far) p.x += 1.0 + 1.3;  // the reach of a contact distance of 1
  const TissueState state = cells({square, far});
  CHECK(contact_energy(state, {.distance = 0.999}) == 0.0);
  CHECK(contact_energy(state, {.distance = 1.001}) < 0.0);
}

TEST_CASE("random tissues meet every case of the contact geometry and of the law", "[unit]") {
  int segments = 0, wedges = 0, patches = 0, repelled = 0, adhering = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const TissueState state = random_tissue(seed);
    const Tissue& tissue = state.tissue;
    const StateView view = state.view();
    const ContactLaw law = make_contact_law(tissue, {});
    for (int v = 0; v < tissue.vertex_count(); ++v)
      for (int cell = 0; cell < tissue.cell_count(); ++cell) {
        if (cell == tissue.cell_of(v)) continue;
        const int first = tissue.first_vertex(cell), count = tissue.vertex_count(cell);
        const std::span x = view.x.subspan(first, count), y = view.y.subspan(first, count);
        const Point p{view.x[v], view.y[v]};
        for_each_contact_feature(
            p, x, y,
            [&](int k, double) {
              const int next = (k + 1) % count;
              const double d = point_segment_distance(p, {x[k], y[k]}, {x[next], y[next]});
              segments += d < law.reach();
              repelled += d < law.distance();
              adhering += d > law.distance() && d < law.reach();
            },
            [&](int k, int weight) {
              if (norm(p - Point{x[k], y[k]}) < law.reach()) ++(weight > 0 ? wedges : patches);
            });
      }
  }
  CHECK(segments > 100);
  CHECK(wedges > 20);
  CHECK(patches > 20);
  CHECK(repelled > 20);
  CHECK(adhering > 20);
}

TEST_CASE("pruning by bounding boxes does not change a bit", "[unit]") {
  for (const double adhesion : {0.0, 0.1})
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      const TissueState state = random_tissue(seed, {.spacing = 0.98});
      const ContactParameters parameters{.adhesion = adhesion};
      const Contact pruned(state.tissue, parameters), complete(state.tissue, parameters, PairSearch::all_pairs);
      const double energy = complete.energy(0.0, state.view());
      REQUIRE(energy != 0.0);
      CHECK(pruned.energy(0.0, state.view()) == energy);
      const std::vector<Point> ours = point_gradient(pruned, state), theirs = point_gradient(complete, state);
      for (std::size_t i = 0; i < ours.size(); ++i) REQUIRE((ours[i].x == theirs[i].x && ours[i].y == theirs[i].y));
    }
}

TEST_CASE("the contact sum equals the clamped form without case distinction", "[unit]") {
  const TissueState state = random_tissue(7);
  const Contact contact(state.tissue, {});
  const Tissue& tissue = state.tissue;
  const StateView view = state.view();
  const auto at = [&](int v) { return Point{view.x[v], view.y[v]}; };
  double sum = 0.0;
  for (int p = 0; p < tissue.vertex_count(); ++p)
    for (int q = 0; q < tissue.vertex_count(); ++q) {
      if (tissue.cell_of(p) == tissue.cell_of(q)) continue;
      sum += contact.law().value(point_segment_distance(at(p), at(q), at(tissue.next(q)))) -
             contact.law().value(norm(at(p) - at(q)));
    }
  CHECK(contact.energy(0.0, view) == Approx(sum).epsilon(1e-12));
}

TEST_CASE("contacts without a direction are failures that name cell and vertex", "[unit]") {
  const std::vector<Point> on_corner{{1, 1}, {2, 1}, {2, 2}}, on_edge{{1, 0.5}, {2, 0}, {2, 1}};
  const std::vector<Point> degenerate{{5, 0}, {6, 0}, {6, 0}, {5, 1}};
  const auto fails = [](const TissueState& state, const std::string& words) {
    const Contact contact(state.tissue, {.distance = 0.5});
    CHECK_THROWS_AS(contact.energy(0.0, state.view()), NumericalError);
    CHECK_THROWS_WITH(point_gradient(contact, state), Catch::Contains(words));
  };
  fails(cells({square, on_corner}), "cell 0, vertex 2 lies exactly on cell 1, vertex 0");
  fails(cells({square, on_edge}), "cell 1, vertex 0 lies exactly on cell 0, vertex 1");
  fails(cells({square, degenerate}), "cell 1, vertex 1: the segment to the next vertex has length zero");
}

TEST_CASE("self-contact repels vertices that are not neighbours", "[unit]") {
  const TissueState state = cells({square});
  const SelfContact near(state.tissue, {.energy = 0.5, .distance = 2.0}),
      far(state.tissue, {.energy = 0.5, .distance = 1.4});
  const double inside = 1.0 - std::sqrt(2.0) / 2.0;
  CHECK(near.energy(0.0, state.view()) == Approx(2 * 0.5 * inside * inside));  // the two diagonals, not the four sides
  CHECK(far.energy(0.0, state.view()) == 0.0);
  const TissueState touching = cells({{{0, 0}, {2, 0}, {1, 1}, {1, 1}, {0, 1}}});
  CHECK(SelfContact(touching.tissue, {.distance = 0.1}).energy(0.0, touching.view()) ==
        0.0);  // neighbours along the membrane
  const TissueState folded = cells({{{0, 0}, {2, 0}, {1, 1}, {2, 2}, {1, 1}}});
  CHECK_THROWS_WITH(SelfContact(folded.tissue, {.distance = 0.1}).energy(0.0, folded.view()),
                    Catch::Contains("cell 0, vertex 2 lies exactly on cell 0, vertex 4"));
}
