#include "support/sample_tissue.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace suture::test {

TissueState sample_tissue(int rings) {
  constexpr double pi = std::numbers::pi;
  constexpr double spacing = 1.13;
  std::vector<int> counts;
  std::vector<CellMaterial> materials;
  std::vector<double> x, y, rest_length;
  for (int q = -rings; q <= rings; ++q)
    for (int r = -rings; r <= rings; ++r) {
      if (std::abs(q + r) > rings || (q == 0 && r == 0)) continue;
      const int n = 18 + (q + 2 * r + 3 * rings) % 5;
      const double cx = spacing * (q + 0.5 * r), cy = spacing * std::sqrt(0.75) * r;
      for (int k = 0; k < n; ++k) {
        const double angle = 2.0 * pi * k / n;
        const double radius = 0.5 * (1.0 + 0.05 * std::cos(6.0 * angle + q));
        x.push_back(cx + radius * std::cos(angle));
        y.push_back(cy + radius * std::sin(angle));
        rest_length.push_back(pi / n * (1.0 + 0.01 * std::sin(k + q)));
      }
      counts.push_back(n);
      materials.push_back({.rest_area = 1.0 + 0.01 * q, .area_stiffness = 16.0 / 3.0, .tau = 9.6 + q, .memory = 0.1});
    }
  materials.front().tau = std::numeric_limits<double>::infinity();
  TissueState state{.tissue = Tissue(counts, materials, rest_length), .time = 100.0 / 3.0};
  std::vector<double> reference = rest_length;
  reference[1] *= 1.0 + 1e-15;
  state.reference_rest_length = std::move(reference);

  PurseString& ring = state.purse_string;
  ring.shrink_rate = 1.0 / 7.0;
  ring.minimum_rest_length = 1e-3 / 3.0;
  constexpr int ring_size = 12;
  std::vector<double> ring_x, ring_y;
  for (int j = 0; j < ring_size; ++j) {
    const double angle = 2.0 * pi * j / ring_size;
    ring_x.push_back(0.6 * std::cos(angle));
    ring_y.push_back(0.6 * std::sin(angle));
    ring.vertex.push_back(7 * j);
    ring.spring.push_back({0.3 + 0.01 * j / 3.0, 33.0 + j / 3.0, 0.31});
    ring.mode.push_back(j % 5 == 4 ? TetherMode::slipped : TetherMode::attached);
  }
  for (const auto* part : {&x, &ring_x, &y, &ring_y, &rest_length})
    state.values.insert(state.values.end(), part->begin(), part->end());
  return state;
}

}  // namespace suture::test
