#include "neighbors/contact_list.hpp"

#include <algorithm>
#include <cmath>

#include "threads/ranges.hpp"

namespace suture {

namespace {

// Cells per tile: a few microseconds of work, and enough tiles of each colour for many threads.
constexpr double tile_cells = 48.0;

}  // namespace

void ContactList::build(const kernels::Shell& shell, const kernels::Table& kernel, WorkerPool& workers) {
  find_boxes(shell, workers);
  fill_buckets();
  make_tiles();
  workers.for_each(colours_.tiles(), [&](int k) { fill_tile(tiles_[k], shell, kernel); });
  active_bands_ = 0;
  age(0.0, workers);
}

void ContactList::age(double moved, WorkerPool& workers) {
  const int wanted = skin_ > 0.0 ? std::min(1 + static_cast<int>(std::ceil(2.0 * moved / skin_ * (bands - 1))), bands) : bands;
  if (wanted <= active_bands_) return;
  active_bands_ = wanted;
  workers.for_each(colours_.tiles(), [&](int k) { activate(tiles_[k]); });
}

/// The kernel works on active windows two by two. They come from eight places of the list in turn: neighbouring vertices push
/// on the same segments, and a load that overlaps a store just made has to wait for it.
void ContactList::activate(Tile& tile) const {
  const std::vector<kernels::Window>& all = tile.windows;
  tile.active.clear();
  const auto take = [&](std::size_t k) {
    if (all[k].band < active_bands_) tile.active.push_back(all[k]);
  };
  const std::size_t share = all.size() / 8;
  for (std::size_t k = 0; k < share; ++k)
    for (const std::size_t place : {0, 4, 1, 5, 2, 6, 3, 7}) take(k + place * share);
  for (std::size_t k = 8 * share; k < all.size(); ++k) take(k);
}

int ContactList::band_of(double distance2) const {
  int band = 0;
  for (double edge = reach_; band < bands - 1 && distance2 >= edge * edge; edge += skin_ / (bands - 1)) ++band;
  return band;
}

void ContactList::find_boxes(const kernels::Shell& shell, WorkerPool& workers) {
  boxes_.resize(shell.cells);
  const Ranges ranges{boxes_.size(), 256};
  workers.for_each(ranges.count(), [&](int k) {
    for (std::size_t c = ranges[k].begin; c < ranges[k].end; ++c) {
      const double *x = shell.x + shell.base[c] + 1, *y = shell.y + shell.base[c] + 1;
      const auto [x0, x1] = std::minmax_element(x, x + shell.count[c]);
      const auto [y0, y1] = std::minmax_element(y, y + shell.count[c]);
      boxes_[c] = {*x0, *y0, *x1, *y1};
    }
  });
}

/// Grid of buckets as wide as the largest box + reach + skin: neighbours lie in the 3 x 3 buckets around a cell's.
void ContactList::fill_buckets() {
  const auto n = static_cast<int>(boxes_.size());
  const double margin = reach_ + skin_;
  double width = margin, x0 = boxes_[0].x0, y0 = boxes_[0].y0, x1 = x0, y1 = y0;
  for (const Box& b : boxes_) {
    width = std::max({width, b.x1 - b.x0 + margin, b.y1 - b.y0 + margin});
    x0 = std::min(x0, b.x0), y0 = std::min(y0, b.y0), x1 = std::max(x1, b.x0), y1 = std::max(y1, b.y0);
  }
  // Cells that fly apart must not cost memory: at most about one bucket per cell.
  width = std::max({width, (x1 - x0) / (std::sqrt(n) + 1.0), (y1 - y0) / (std::sqrt(n) + 1.0)});
  nx_ = static_cast<int>((x1 - x0) / width) + 1, ny_ = static_cast<int>((y1 - y0) / width) + 1;
  bucket_start_.assign(nx_ * ny_ + 1, 0);
  bucket_of_.resize(n);
  bucket_cells_.resize(n);
  for (int c = 0; c < n; ++c) {
    bucket_of_[c] = static_cast<int>((boxes_[c].x0 - x0) / width) + nx_ * static_cast<int>((boxes_[c].y0 - y0) / width);
    ++bucket_start_[bucket_of_[c] + 1];
  }
  for (int k = 0; k < nx_ * ny_; ++k) bucket_start_[k + 1] += bucket_start_[k];
  cursor_.assign(bucket_start_.begin(), bucket_start_.end() - 1);
  for (int c = 0; c < n; ++c) bucket_cells_[cursor_[bucket_of_[c]]++] = c;
}

/// Squares of buckets, numbered by colour.
void ContactList::make_tiles() {
  const auto n = static_cast<int>(boxes_.size());
  const int edge = tiled_ ? std::max(1, static_cast<int>(std::lround(std::sqrt(tile_cells * nx_ * ny_ / n)))) : std::max(nx_, ny_);
  const int columns = (nx_ + edge - 1) / edge, rows = (ny_ + edge - 1) / edge;
  tile_at_.resize(rows * columns);
  int tiles = 0;
  for (int colour = 0; colour < TileColours::count; ++colour) {
    colours_.start[colour] = tiles;
    for (int j = colour / 3; j < rows; j += 3)
      for (int i = colour % 3; i < columns; i += 3) tile_at_[i + columns * j] = tiles++;
  }
  colours_.start[TileColours::count] = tiles;
  tiles_.resize(std::max<std::size_t>(tiles_.size(), tiles));
  for (Tile& tile : tiles_) tile.cells.clear();
  for (int c = 0; c < n; ++c) tiles_[tile_at_[bucket_of_[c] % nx_ / edge + columns * (bucket_of_[c] / nx_ / edge)]].cells.push_back(c);
}

void ContactList::fill_tile(Tile& tile, const kernels::Shell& shell, const kernels::Table& kernel) const {
  tile.windows.clear();
  tile.self_pairs.clear();
  for (const int c : tile.cells) {
    find_neighbors(tile, c);
    for (int slot = shell.base[c] + 1; slot <= shell.base[c] + shell.count[c]; ++slot) add_windows(tile, shell, kernel, slot);
    if (self_reach_ > 0.0) add_self_pairs(tile, shell, c);
  }
}

/// Cells whose boxes come within reach + skin, ascending.
void ContactList::find_neighbors(Tile& tile, int cell) const {
  const double margin = reach_ + skin_;
  const Box& a = boxes_[cell];
  const int bx = bucket_of_[cell] % nx_, by = bucket_of_[cell] / nx_;
  tile.neighbors.clear();
  for (int j = std::max(by - 1, 0); j <= std::min(by + 1, ny_ - 1); ++j)
    for (int i = std::max(bx - 1, 0); i <= std::min(bx + 1, nx_ - 1); ++i)
      for (int k = bucket_start_[i + nx_ * j]; k < bucket_start_[i + nx_ * j + 1]; ++k) {
        const int other = bucket_cells_[k];
        const Box& b = boxes_[other];
        if (other != cell && b.x0 < a.x1 + margin && b.x1 > a.x0 - margin && b.y0 < a.y1 + margin && b.y1 > a.y0 - margin)
          tile.neighbors.push_back(other);
      }
  std::sort(tile.neighbors.begin(), tile.neighbors.end());
}

void ContactList::add_windows(Tile& tile, const kernels::Shell& shell, const kernels::Table& kernel, int slot) const {
  const double margin = reach_ + skin_, px = shell.x[slot], py = shell.y[slot];
  for (const int other : tile.neighbors) {
    const Box& b = boxes_[other];
    if (px < b.x0 - margin || px > b.x1 + margin || py < b.y0 - margin || py > b.y1 + margin) continue;
    tile.words.resize(std::max<std::size_t>(tile.words.size(), (shell.count[other] + 63) / 64));
    tile.distance2.resize(std::max<std::size_t>(tile.distance2.size(), (shell.count[other] + 7) / 8 * 8));
    kernel.near_segments(shell, other, px, py, margin * margin, tile.words.data(), tile.distance2.data());
    cut_windows(tile, slot, shell.base[other] + 1, shell.count[other]);
  }
}

/// Windows over the near segments of one cell, from the bits of words. Numbering is cyclic: a run that goes over the end
/// is taken up at its beginning, so that it is not cut there.
void ContactList::cut_windows(Tile& tile, int slot, int first_slot, int n) const {
  std::vector<int>& near = tile.near;
  near.clear();
  for (int w = 0; 64 * w < n; ++w)
    for (unsigned long long word = tile.words[w]; word != 0; word &= word - 1) near.push_back(64 * w + __builtin_ctzll(word));
  const int count = static_cast<int>(near.size());
  if (count == 0) return;
  int lead = 0;  // where the run over the end begins in near
  if (near.front() == 0 && near.back() == n - 1)
    for (lead = count - 1; lead > 1 && near[lead - 1] == near[lead] - 1;) --lead;
  const auto ordered = [&](int k) { return near[lead + k < count ? lead + k : lead + k - count]; };
  for (int k = 0; k < count;) {
    const int first = ordered(k);
    int length = 1;
    double distance2 = tile.distance2[first];
    for (++k; k < count; ++k) {
      const int next = ordered(k), ahead = next >= first ? next - first : next + n - first;
      if (ahead >= kernels::window_segments) break;
      length = ahead + 1;
      distance2 = std::min(distance2, tile.distance2[next]);
    }
    tile.windows.push_back({slot, first_slot + first, static_cast<std::int16_t>(length), static_cast<std::int16_t>(band_of(distance2))});
  }
}

void ContactList::add_self_pairs(Tile& tile, const kernels::Shell& shell, int cell) const {
  const int b = shell.base[cell] + 1, n = shell.count[cell];
  const double reach = self_reach_ + skin_;
  for (int i = 0; i < n; ++i)
    for (int j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const double dx = shell.x[b + i] - shell.x[b + j], dy = shell.y[b + i] - shell.y[b + j];
      if (dx * dx + dy * dy < reach * reach) tile.self_pairs.push_back({b + i, b + j});
    }
}

}  // namespace suture
