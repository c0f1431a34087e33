// Verlet list of the contact kernel: for every vertex, the windows of segments of other cells within reach + skin, and
// the pairs of non-adjacent vertices of one cell. A superset of what interacts as long as no vertex has moved by more
// than skin/2 since it was built; the extra entries contribute exactly zero, so the age of the list cannot change a
// force by more than the rounding of a sum in another order.
//
// Every window knows the band of distances it was in when the list was built. As long as no vertex has moved by more than
// m, what was farther than reach + 2 m away is out of reach, and only the bands before that are active.
//
// The list of a large tissue is cut into square tiles in space. The windows of a tile touch cells of the 3 x 3 tiles
// around it only, so tiles of one colour (row and column modulo 3) touch no common cell: they can be worked on at once,
// and colour after colour gives every sum one order, whoever works.
#pragma once

#include <array>
#include <vector>

#include "kernels/kernels.hpp"
#include "threads/worker_pool.hpp"

namespace suture {

/// Tiles of colour c are numbered start[c] .. start[c + 1] - 1.
struct TileColours {
  static constexpr int count = 9;
  std::array<int, count + 1> start{};
  int tiles() const { return start[count]; }
  /// task(tile), for tiles that touch no common cell at once.
  template <class Task>
  void for_each_tile(WorkerPool& workers, const Task& task) const {
    for (int c = 0; c < count; ++c) workers.for_each(start[c + 1] - start[c], [&](int k) { task(start[c] + k); });
  }
};

class ContactList {
 public:
  /// Band 0 was within reach when the list was built; the others divide the skin evenly.
  static constexpr int bands = 5;
  struct Tile {
    std::vector<int> cells;  ///< ascending
    std::vector<kernels::Window> windows;  ///< of the vertices of `cells`, in their order
    std::vector<kernels::Window> active;   ///< what can be in reach, so ordered that neighbours in the list are far apart in space
    std::vector<kernels::SelfPair> self_pairs;
    // Scratch: neighbours of one cell; near segments of one of them, as bits and as numbers; squared distances of all.
    std::vector<int> neighbors, near;
    std::vector<unsigned long long> words;
    std::vector<double> distance2;
  };

  ContactList() = default;
  /// tiled: false keeps everything in one tile.
  ContactList(double reach, double self_reach, double skin, bool tiled = false)
      : reach_(reach), self_reach_(self_reach), skin_(skin), tiled_(tiled) {}

  /// Rebuilds from the padded positions and segments of `shell` (wrapped, segment arrays up to date).
  void build(const kernels::Shell& shell, const kernels::Table& kernel, WorkerPool& workers = WorkerPool::alone());

  /// Says how far the farthest vertex has moved since, at most skin/2. Active bands stay active.
  void age(double moved, WorkerPool& workers);

  const TileColours& colours() const { return colours_; }
  const Tile& tile(int k) const { return tiles_[k]; }
  double skin() const { return skin_; }

 private:
  struct Box {
    double x0, y0, x1, y1;
  };
  void find_boxes(const kernels::Shell& shell, WorkerPool& workers);
  void fill_buckets();
  void make_tiles();
  void fill_tile(Tile& tile, const kernels::Shell& shell, const kernels::Table& kernel) const;
  void find_neighbors(Tile& tile, int cell) const;
  void add_windows(Tile& tile, const kernels::Shell& shell, const kernels::Table& kernel, int slot) const;
  void cut_windows(Tile& tile, int slot, int first_slot, int n) const;
  int band_of(double distance2) const;
  void activate(Tile& tile) const;
  void add_self_pairs(Tile& tile, const kernels::Shell& shell, int cell) const;

  double reach_ = 0.0, self_reach_ = 0.0, skin_ = 0.0;
  bool tiled_ = false;
  int active_bands_ = 0;
  std::vector<Tile> tiles_;  // the first colours_.tiles() are in use; the others keep their memory
  TileColours colours_;
  std::vector<Box> boxes_;
  // Cells sorted by the grid bucket of their box corner, nx_ by ny_ buckets.
  int nx_ = 0, ny_ = 0;
  std::vector<int> bucket_start_, bucket_cells_, bucket_of_, cursor_;
  std::vector<int> tile_at_;  // number of the tile in each place of the grid of tiles
};

}  // namespace suture
