// Steps that carry a vertex through the membrane of another cell.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "support/wound_tissues.hpp"
#include "suture/measure/polygon.hpp"
#include "suture/ode/tissue_ode.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

/// Evaluates there first, as an integrator does.
class Steps {
 public:
  explicit Steps(const TissueState& state) : state_(state), ode_(state.tissue, 0, options(), {}), out_(state.values.size()) {}

  bool jump(const std::vector<double>& before, const std::vector<double>& after) {
    REQUIRE(ode_.rate(0.0, after, out_) == Evaluation::ok);
    return ode_.jumps(before, after);
  }
  std::string refusal() const { return ode_.refusal(); }
  Point at(const std::vector<double>& y, int v) const { return {y[state_.layout().x(v)], y[state_.layout().y(v)]}; }
  std::vector<double> moved(const std::vector<double>& y, int v, Point by) const {
    std::vector<double> result = y;
    result[state_.layout().x(v)] += by.x, result[state_.layout().y(v)] += by.y;
    return result;
  }
  bool inside(const std::vector<double>& y, int v, int cell) const {
    Polygon outline;
    for (int w = state_.tissue.first_vertex(cell); w < state_.tissue.end_vertex(cell); ++w) outline.push_back(at(y, w));
    return contains(outline, at(y, v));
  }
  /// A vertex inside a cell where it was not before, found by looking at all of them.
  bool any_goes_through(const std::vector<double>& before, const std::vector<double>& after) const {
    for (int v = 0; v < state_.tissue.vertex_count(); ++v)
      for (int cell = 0; cell < state_.tissue.cell_count(); ++cell)
        if (cell != state_.tissue.cell_of(v) && inside(after, v, cell) && !inside(before, v, cell)) return true;
    return false;
  }

 private:
  static TissueOdeOptions options() {
    TissueOdeOptions options;
    options.contact.distance = default_membrane().contact_distance;
    return options;
  }
  const TissueState& state_;
  TissueOde ode_;
  std::vector<double> out_;
};

const double s = default_membrane().contact_distance;

}  // namespace

TEST_CASE("a vertex that jumps over a contact is noticed, one that comes close is not", "[unit]") {
  const TissueState state = tissue_of(honeycomb({.rings = 1}));
  Steps steps(state);
  const std::vector<double>& y = state.values;
  const int v = 2;  // of the first cell
  // Outwards from its cell, to where the nearest membrane of another cell is.
  double least = 1e300;
  Point to{};
  for (int w = state.tissue.end_vertex(0); w < state.tissue.vertex_count(); ++w) {
    const Point way = steps.at(y, w) - steps.at(y, v);
    if (const double d = std::hypot(way.x, way.y); d < least) least = d, to = (1.0 / d) * way;
  }
  REQUIRE(least < 1.2 * s);
  CHECK_FALSE(steps.jump(y, steps.moved(y, v, (least - 0.3 * s) * to)));
  const std::vector<double> through = steps.moved(y, v, (least + 0.4 * s) * to);
  CHECK(steps.jump(y, through));
  CHECK_THAT(steps.refusal(), Contains("cell 0, vertex 2") && Contains("membrane"));
  CHECK_FALSE(steps.jump(through, through));
  CHECK_FALSE(steps.jump(through, steps.moved(through, v, 0.3 * s * to)));  // has been inside before
  CHECK_FALSE(steps.jump(through, y));                                      // back out
  // What is resolved may go anywhere: contacts can give way to a force that is large enough.
  CHECK_FALSE(steps.jump(steps.moved(y, v, (least - 0.05 * s) * to), steps.moved(y, v, (least + 0.1 * s) * to)));
}

TEST_CASE("jumps are those that looking at every vertex and every cell finds", "[unit]") {
  TissueState state = tissue_of(honeycomb({.rings = 2, .gap = 0.9 * s}));
  shake(state, 0.1 * s, 5);
  Steps steps(state);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(0.0, 6.28), length(0.25 * s, 1.6 * s);
  std::uniform_int_distribution<int> any(0, state.tissue.vertex_count() - 1);
  int through = 0, not_through = 0;
  for (int k = 0; k < 1500; ++k) {
    const int v = any(random);
    const double a = angle(random), l = length(random);
    const std::vector<double> after = steps.moved(state.values, v, {l * std::cos(a), l * std::sin(a)});
    const bool expected = steps.any_goes_through(state.values, after);
    CAPTURE(k, v, a, l / s);
    CHECK(steps.jump(state.values, after) == expected);
    ++(expected ? through : not_through);
  }
  CHECK(through > 80);
  CHECK(not_through > 500);
}
