// Fig. S2: energy and force on a vertex that passes a convex and a concave corner of another membrane, by three sums: the
// inclusion-exclusion sum ("corrected"), the same without its negative terms ("uncorrected": the rectangles overlap at a concave
// corner and count twice), and the rectangles along the segments alone (which leave a gap at a convex corner).
// Second table: the largest change between neighbouring points of the path as the points get denser. It falls with the
// spacing where the quantity is continuous and stays where it jumps.
#include <algorithm>
#include <cmath>

#include "../csv.hpp"
#include "suture/geometry/point.hpp"
#include "suture/physics/contact_geometry.hpp"
#include "suture/physics/contact_law.hpp"

using namespace suture;
using namespace suture::figures;

namespace {

struct Chain {
  const char* name;
  std::vector<double> x, y;  // counter-clockwise; the corner at the origin
  double path_height;        // the vertex moves along y = path_height
};

enum class Sum { corrected, uncorrected, rectangles };

const char* name_of(Sum sum) {
  return sum == Sum::corrected ? "corrected" : sum == Sum::uncorrected ? "uncorrected" : "rectangles";
}

struct Felt {
  double energy = 0.0, fx = 0.0, fy = 0.0;
};

/// Energy of a vertex at p, and the force on it.
Felt felt_at(Point p, const Chain& chain, const ContactLaw& law, Sum sum) {
  Felt felt;
  const auto add = [&](double weight, double qx, double qy) {
    const double dx = p.x - qx, dy = p.y - qy, d = std::hypot(dx, dy);
    const double pull = -weight * law.first_derivative(d) / d;
    felt.energy += weight * law.value(d);
    felt.fx += pull * dx, felt.fy += pull * dy;
  };
  for_each_contact_feature(
      p, chain.x, chain.y,
      [&](int k, double t) {
        const std::size_t next = (k + 1) % chain.x.size();
        add(1.0, chain.x[k] + t * (chain.x[next] - chain.x[k]), chain.y[k] + t * (chain.y[next] - chain.y[k]));
      },
      [&](int k, int weight) {
        if (sum == Sum::corrected || (sum == Sum::uncorrected && weight > 0)) add(weight, chain.x[k], chain.y[k]);
      });
  return felt;
}

std::vector<Point> path(const Chain& chain, int points) {
  std::vector<Point> result;
  for (int i = 0; i <= points; ++i) result.push_back({-0.9 + 1.8 * i / points, chain.path_height});
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  return figure_main(argc, argv, [](const auto& out, const auto&, const auto&) {
    // Lengths in contact distances s; the segments of a default cell are as long as s.
    const Chain chains[] = {{"convex", {-1.0, -1.0, 1.0, 1.0, 0.0}, {-0.6, -6.0, -6.0, -0.6, 0.0}, 0.75},
                            {"concave", {-1.0, -1.0, 1.0, 1.0, 0.0}, {0.6, -6.0, -6.0, 0.6, 0.0}, 0.95}};
    const ContactLaw law(0.5, 1.0, 0.1, 0.3);
    CsvFile curves(out / "paths.csv", "corner,sum,x,y,energy,fx,fy");
    CsvFile steps(out / "refinement.csv", "corner,sum,spacing,largest_energy_step,largest_force_step");
    for (const Chain& chain : chains)
      for (const Sum sum : {Sum::corrected, Sum::uncorrected, Sum::rectangles}) {
        for (const Point p : path(chain, 720)) {
          const Felt felt = felt_at(p, chain, law, sum);
          curves.row(chain.name, name_of(sum), p.x, p.y, felt.energy, felt.fx, felt.fy);
        }
        for (int points = 180; points <= 184320; points *= 4) {
          double energy_step = 0.0, force_step = 0.0;
          Felt last;
          bool first = true;
          for (const Point p : path(chain, points)) {
            const Felt felt = felt_at(p, chain, law, sum);
            if (!first) energy_step = std::max(energy_step, std::abs(felt.energy - last.energy));
            if (!first) force_step = std::max(force_step, std::hypot(felt.fx - last.fx, felt.fy - last.fy));
            last = felt, first = false;
          }
          steps.row(chain.name, name_of(sum), 1.8 / points, energy_step, force_step);
        }
      }
  });
}
