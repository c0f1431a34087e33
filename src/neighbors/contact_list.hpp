// Verlet list of the contact kernel: for every vertex, the windows of segments of other cells within reach + skin, and
// the pairs of non-adjacent vertices of one cell. A superset of what interacts as long as no vertex has moved by more
// than skin/2 since it was built; the extra entries contribute exactly zero, so the age of the list cannot change a
// force by more than the rounding of a sum in another order.
//
// Every window knows the band of distances it was in when the list was built. As long as no vertex has moved by more than
// m, what was farther than reach + 2 m away is out of reach, and only the bands before that are active.
//
// The list of a large tissue is several (contact_schedule.hpp).
#pragma once

#include <span>
#include <vector>

#include "kernels/kernels.hpp"
#include "neighbors/contact_schedule.hpp"
#include "neighbors/window_groups.hpp"
#include "threads/worker_pool.hpp"

namespace suture {

class ContactList {
 public:
  /// Band 0 was within reach when the list was built; the others divide the skin evenly.
  static constexpr int bands = WindowGroups::bands;
  struct Entries {
    std::vector<kernels::Window> windows;  ///< by the vertex's cell, vertex and other cell
    WindowGroups groups;                   ///< the same
    std::vector<kernels::SelfPair> self_pairs;
  };

  ContactList() = default;
  /// cells_per_block: 0 keeps everything in one list.
  ContactList(double reach, double self_reach, double skin, int cells_per_block = 0)
      : reach_(reach), self_reach_(self_reach), skin_(skin), cells_per_block_(cells_per_block) {}

  /// Rebuilds from the padded positions and segments of `shell` (wrapped, segment arrays up to date).
  void build(const kernels::Shell& shell, const kernels::Table& kernel, WorkerPool& workers = WorkerPool::alone());

  /// Says how far the farthest vertex has moved since, at most skin/2. Active bands stay active.
  void age(double moved);

  const ContactSchedule& schedule() const { return schedule_; }
  const Entries& entries(int list) const { return lists_[list]; }
  /// How many windows of entries(list).groups can be in reach.
  std::size_t active(int list) const { return lists_[list].groups.windows(active_bands_); }
  double skin() const { return skin_; }

 private:
  struct Box {
    double x0, y0, x1, y1;
  };
  struct Neighbor {
    int cell, list;
  };
  /// What building a part's lists needs: neighbours of one cell; near segments of one of them, as bits and as numbers; squared
  /// distances of all.
  struct Scratch {
    std::vector<Neighbor> neighbors;
    std::vector<int> near;
    std::vector<unsigned long long> words;
    std::vector<double> distance2;
  };
  void find_boxes(const kernels::Shell& shell, WorkerPool& workers);
  void fill_buckets();
  void fill_part(int part, const kernels::Shell& shell, const kernels::Table& kernel);
  void find_neighbors(int cell, std::vector<Neighbor>& neighbors) const;
  void add_windows(Scratch& scratch, const kernels::Shell& shell, const kernels::Table& kernel, int slot);
  void cut_windows(Scratch& scratch, int slot, int first_slot, int n, std::vector<kernels::Window>& windows) const;
  void cut_run(std::span<const int> run, const Scratch& scratch, int slot, int first_slot, std::vector<kernels::Window>& windows) const;
  int band_of(double distance2) const;
  void add_self_pairs(Entries& entries, const kernels::Shell& shell, int cell) const;

  double reach_ = 0.0, self_reach_ = 0.0, skin_ = 0.0;
  int cells_per_block_ = 0, active_bands_ = 0;
  ContactSchedule schedule_;
  std::vector<Entries> lists_;
  std::vector<Scratch> scratch_;  // per part
  std::vector<Box> boxes_;
  // Cells sorted by the grid bucket of their box corner, nx_ by ny_ buckets.
  int nx_ = 0, ny_ = 0;
  std::vector<int> bucket_start_, bucket_cells_, bucket_of_, cursor_;
};

}  // namespace suture
