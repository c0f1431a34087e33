// Verlet list of the contact kernel: for every vertex, the windows of segments of other cells within reach + skin, and
// the pairs of non-adjacent vertices of one cell. A superset of what interacts as long as no vertex has moved by more
// than skin/2 since it was built; the extra entries contribute exactly zero, so the age of the list cannot change a
// force by more than the rounding of a sum in another order.
//
// Every window knows the band of distances it was in when the list was built. As long as no vertex has moved by more than
// m, what was farther than reach + 2 m away is out of reach, and only the bands before that are active.
//
// The list of a large tissue is several (contact_schedule.hpp), each as old as the cells it is about.
#pragma once

#include <algorithm>
#include <cmath>
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
    std::vector<int> blocks;               ///< all whose vertices or segments are listed, and perhaps some near them
    std::vector<int> completes;            ///< blocks that no list behind this one is about
    int active_bands = bands;
  };

  ContactList() = default;
  /// cells_per_block: 0 keeps everything in one list.
  ContactList(double reach, double self_reach, double skin, int cells_per_block = 0)
      : reach_(reach), self_reach_(self_reach), skin_(skin), cells_per_block_(cells_per_block) {}

  /// Rebuilds from the padded positions and segments of `shell` (wrapped, segment arrays up to date).
  void build(const kernels::Shell& shell, const kernels::Table& kernel, WorkerPool& workers = WorkerPool::alone());

  /// Says how far the farthest vertex of entries(list).blocks is from where it was, at most skin/2.
  void age(int list, double moved) {
    lists_[list].active_bands =
        skin_ > 0.0 ? std::min(1 + static_cast<int>(std::ceil(2.0 * moved / skin_ * (bands - 1))), bands) : bands;
  }

  const ContactSchedule& schedule() const { return schedule_; }
  const Entries& entries(int list) const { return lists_[list]; }
  /// How many windows of entries(list).groups can be in reach.
  std::size_t active(int list) const { return lists_[list].groups.windows(lists_[list].active_bands); }
  double skin() const { return skin_; }

 private:
  struct Box {
    double x0, y0, x1, y1;
  };
  struct Neighbor {
    int cell, list;
  };
  /// Room for building a part's lists: of one cell, its neighbours and what kernels::NearQuery works with; windows of some vertices.
  struct Scratch {
    std::vector<Neighbor> neighbors;
    std::vector<double> box_room, distance2;
    std::vector<kernels::NearBoxes::Of> box_of;
    std::vector<std::uint64_t> rows, columns;
    std::vector<kernels::NearGroup> groups;
    std::vector<unsigned char> bits;
    std::vector<int> found, segments, numbers;
    std::vector<kernels::NearRun> runs;
    std::vector<kernels::Window> windows;
  };
  void find_boxes(const kernels::Shell& shell, const kernels::Table& kernel, WorkerPool& workers);
  void fill_buckets();
  void fill_part(int part, const kernels::Shell& shell, const kernels::Table& kernel);
  void find_neighbors(int cell, std::vector<Neighbor>& neighbors) const;
  /// Their lists are about this cell and them.
  void note_blocks(int cell, const std::vector<Neighbor>& neighbors);
  void note_completions();
  kernels::NearQuery query_around(int cell, const kernels::Shell& shell, const kernels::Table& kernel, Scratch& scratch) const;
  void add_windows(Scratch& scratch, const kernels::Shell& shell, const kernels::Table& kernel, int cell);
  void add_self_pairs(Scratch& scratch, Entries& entries, const kernels::Shell& shell, const kernels::Table& kernel, int cell) const;

  double reach_ = 0.0, self_reach_ = 0.0, skin_ = 0.0;
  int cells_per_block_ = 0;
  ContactSchedule schedule_;
  std::vector<Entries> lists_;
  std::vector<Scratch> scratch_;  // per part
  std::vector<int> last_list_;    // about a block
  std::vector<Box> boxes_;
  std::vector<int> first_segment_box_;
  std::vector<double> segment_box_room_;
  kernels::SegmentBoxes segment_boxes_;
  // Cells sorted by the grid bucket of their box corner, nx_ by ny_ buckets.
  int nx_ = 0, ny_ = 0;
  std::vector<int> bucket_start_, bucket_cells_, bucket_of_, cursor_;
};

}  // namespace suture
