// The second derivatives of the extra terms (purse string, wall, loads) as a list of blocks, ready for products.
#pragma once

#include <span>
#include <vector>

#include "ode/cell_preconditioner.hpp"
#include "suture/model/state.hpp"
#include "suture/physics/term.hpp"

namespace suture {

/// Keeps the extra terms' second derivatives as a list, ready for products.
class BlockList final : public HessianSink {
 public:
  struct RankOne {
    int first;
    double coefficient;
    std::vector<double> gx, gy;
  };
  void add_block(int i, int j, const Block& block) override { blocks.push_back({i, j, block}); }
  void add_rank_one(int first, double coefficient, std::span<const double> gx, std::span<const double> gy) override {
    rank_ones.push_back({first, coefficient, {gx.begin(), gx.end()}, {gy.begin(), gy.end()}});
  }
  void clear() {
    blocks.clear();
    rank_ones.clear();
  }
  /// out += factor H v.
  void add_product(double factor, const StateLayout& layout, std::span<const double> v, std::span<double> out) const {
    const double *vx = v.data(), *vy = vx + layout.points();
    double *ox = out.data(), *oy = ox + layout.points();
    for (const auto& [i, j, b] : blocks) {
      ox[i] += factor * (b[0] * vx[j] + b[1] * vy[j]);
      oy[i] += factor * (b[2] * vx[j] + b[3] * vy[j]);
      if (i == j) continue;
      ox[j] += factor * (b[0] * vx[i] + b[2] * vy[i]);
      oy[j] += factor * (b[1] * vx[i] + b[3] * vy[i]);
    }
    for (const RankOne& r : rank_ones) {
      double dot = 0.0;
      for (std::size_t k = 0; k < r.gx.size(); ++k) dot += r.gx[k] * vx[r.first + k] + r.gy[k] * vy[r.first + k];
      for (std::size_t k = 0; k < r.gx.size(); ++k) {
        ox[r.first + k] += factor * r.coefficient * dot * r.gx[k];
        oy[r.first + k] += factor * r.coefficient * dot * r.gy[k];
      }
    }
  }
  std::vector<PointBlock> blocks;
  std::vector<RankOne> rank_ones;
};

}  // namespace suture
