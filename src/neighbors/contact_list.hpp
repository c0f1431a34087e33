// Verlet list of the contact kernel: for every vertex, the windows of segments of other cells within reach + skin, and
// the pairs of non-adjacent vertices of one cell. A superset of what interacts as long as no vertex has moved by more
// than skin/2 since it was built; the extra entries contribute exactly zero, so the age of the list cannot change a
// force by more than the rounding of a sum in another order.
#pragma once

#include <vector>

#include "kernels/kernels.hpp"

namespace suture {

class ContactList {
 public:
  ContactList() = default;
  ContactList(double reach, double self_reach, double skin) : reach_(reach), self_reach_(self_reach), skin_(skin) {}

  /// Rebuilds from the padded positions and segments of `shell` (wrapped, segment arrays up to date).
  void build(const kernels::Shell& shell, const kernels::Table& kernel);

  const std::vector<kernels::Window>& windows() const { return windows_; }
  const std::vector<kernels::SelfPair>& self_pairs() const { return self_pairs_; }
  double skin() const { return skin_; }

 private:
  struct Box {
    double x0, y0, x1, y1;
  };
  void find_neighbor_cells(const kernels::Shell& shell);
  void add_windows(const kernels::Shell& shell, const kernels::Table& kernel, int cell, int slot);
  void cut_windows(int slot, int first_slot, int n);
  void add_self_pairs(const kernels::Shell& shell, int cell);

  double reach_ = 0.0, self_reach_ = 0.0, skin_ = 0.0;
  std::vector<kernels::Window> windows_;
  std::vector<kernels::SelfPair> self_pairs_;
  std::vector<Box> boxes_;
  std::vector<int> bucket_start_, bucket_cells_, bucket_of_;  // cells sorted by the grid bucket of their box corner
  std::vector<int> neighbor_start_, neighbors_;               // cells whose boxes come within reach + skin
  std::vector<unsigned long long> words_;  // near segments of one cell, as bits
  std::vector<int> near_;                  // and as numbers
};

}  // namespace suture
