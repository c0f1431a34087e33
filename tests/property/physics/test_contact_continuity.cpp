// The smooth membrane: energy and force are continuous along any path past convex and concave corners.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "support/invariance.hpp"
#include "suture/physics/contact.hpp"
#include "suture/physics/contact_geometry.hpp"

using namespace suture;
using namespace suture::test;

namespace {

// A block with a shallow notch in its top: a concave corner at (1, 0.6), convex ones elsewhere.
const std::vector<double> block_x{0, 2, 2, 1, 0}, block_y{0, 0, 1, 0.6, 1};
const ContactLaw law(0.5, 0.4, 0.1, 0.3);

Point above(double s) { return {-0.4 + 2.8 * s, 0.9 + 0.3 * std::pow(-1.4 + 2.8 * s, 2)}; }
Point inside(double s) { return {0.3 + 1.4 * s, 0.33 + 0.1 * std::pow(-0.7 + 1.4 * s, 2)}; }

/// Largest change of `values` (any number of components) between neighbouring samples of a path.
double largest_change(int samples, const std::function<std::vector<double>(double)>& values) {
  std::vector<double> last = values(0.0);
  double largest = 0.0;
  for (int k = 1; k <= samples; ++k) {
    const std::vector<double> now = values(static_cast<double>(k) / samples);
    for (std::size_t i = 0; i < now.size(); ++i) largest = std::max(largest, std::abs(now[i] - last[i]));
    last = now;
  }
  return largest;
}

/// By how much the largest change shrinks when the path is sampled four times as finely: 4 for a Lipschitz function, 1
/// for one that jumps.
double refinement(const std::function<std::vector<double>(double)>& values) {
  return largest_change(2000, values) / largest_change(8000, values);
}

/// Energy of the point p with the block; weight decides what a vertex counts.
double energy(Point p, const std::function<int(int)>& weight) {
  double sum = 0.0;
  for_each_contact_feature(
      p, block_x, block_y,
      [&](int k, double) {
        const int next = (k + 1) % 5;
        sum += law.value(point_segment_distance(p, {block_x[k], block_y[k]}, {block_x[next], block_y[next]}));
      },
      [&](int k, int c) {
        sum += weight(c) * law.value(norm(p - Point{block_x[k], block_y[k]}));
      });
  return sum;
}

int corrected(int c) { return c; }
int without_patch(int c) { return std::max(c, 0); }
int without_wedge(int c) { return std::min(c, 0); }

/// The block and a small triangle whose lower tip is at `tip`, at rest length 1.
TissueState block_and_triangle(Point tip) {
  TissueState state;
  state.tissue = Tissue({5, 3}, std::vector<CellMaterial>(2), std::vector<double>(8, 1.0));
  state.values = block_x;
  for (const double dx : {0.0, 0.07, -0.05}) state.values.push_back(tip.x + dx);
  state.values.insert(state.values.end(), block_y.begin(), block_y.end());
  for (const double dy : {0.0, 0.1, 0.09}) state.values.push_back(tip.y + dy);
  state.values.resize(24, 1.0);
  return state;
}

}  // namespace

TEST_CASE("the contact energy of a point is continuous past every corner, on either side", "[property]") {
  for (const auto& path : {above, inside}) {
    const auto sum = [&](double s) { return std::vector<double>{energy(path(s), corrected)}; };
    CHECK(largest_change(2000, sum) > 1e-5);
    CHECK(refinement(sum) == Approx(4.0).margin(0.2));
  }
}

TEST_CASE("the uncorrected sums jump where the corrected one does not", "[property]") {
  const auto doubled = [&](double s) { return std::vector<double>{energy(above(s), without_patch)}; };
  const auto gap = [&](double s) { return std::vector<double>{energy(inside(s), without_wedge)}; };
  CHECK(refinement(doubled) == Approx(1.0).margin(0.05));
  CHECK(refinement(gap) == Approx(1.0).margin(0.05));
  CHECK(largest_change(8000, doubled) > 1e-3);
  CHECK(largest_change(8000, gap) > 1e-3);
}

TEST_CASE("contact energy and every force are continuous while one cell slides past the corners of another",
          "[property]") {
  const ContactParameters parameters{.energy = 0.5, .distance = 0.4, .adhesion = 0.1, .range = 0.3};
  const auto energies = [&](double s) {
    const TissueState state = block_and_triangle(above(s));
    return std::vector<double>{Contact(state.tissue, parameters).energy(0.0, state.view())};
  };
  const auto forces = [&](double s) {
    const TissueState state = block_and_triangle(above(s));
    std::vector<double> components;
    for (const Point& g : point_gradient(Contact(state.tissue, parameters), state)) {
      components.push_back(g.x);
      components.push_back(g.y);
    }
    return components;
  };
  CHECK(largest_change(2000, forces) > 1e-4);
  CHECK(refinement(energies) == Approx(4.0).margin(0.2));
  CHECK(refinement(forces) == Approx(4.0).margin(0.3));
}
