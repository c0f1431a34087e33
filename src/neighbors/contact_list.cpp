#include "neighbors/contact_list.hpp"

#include <algorithm>
#include <cmath>

namespace suture {

void ContactList::build(const kernels::Shell& shell, const kernels::Table& kernel) {
  windows_.clear();
  self_pairs_.clear();
  boxes_.resize(shell.cells);
  int largest = 0;
  for (int c = 0; c < shell.cells; ++c) {
    const double *x = shell.x + shell.base[c] + 1, *y = shell.y + shell.base[c] + 1;
    const auto [x0, x1] = std::minmax_element(x, x + shell.count[c]);
    const auto [y0, y1] = std::minmax_element(y, y + shell.count[c]);
    boxes_[c] = {*x0, *y0, *x1, *y1};
    largest = std::max(largest, shell.count[c]);
  }
  words_.resize((largest + 63) / 64);
  find_neighbor_cells(shell);
  for (int c = 0; c < shell.cells; ++c) {
    for (int slot = shell.base[c] + 1; slot <= shell.base[c] + shell.count[c]; ++slot) add_windows(shell, kernel, c, slot);
    if (self_reach_ > 0.0) add_self_pairs(shell, c);
  }
}

/// Grid of buckets as wide as the largest box + reach + skin: neighbours lie in the 3 x 3 buckets around a cell's.
void ContactList::find_neighbor_cells(const kernels::Shell& shell) {
  const int n = shell.cells;
  const double margin = reach_ + skin_;
  double width = margin, x0 = boxes_[0].x0, y0 = boxes_[0].y0, x1 = x0, y1 = y0;
  for (const Box& b : boxes_) {
    width = std::max({width, b.x1 - b.x0 + margin, b.y1 - b.y0 + margin});
    x0 = std::min(x0, b.x0), y0 = std::min(y0, b.y0), x1 = std::max(x1, b.x0), y1 = std::max(y1, b.y0);
  }
  // Cells that fly apart must not cost memory: at most about one bucket per cell.
  width = std::max({width, (x1 - x0) / (std::sqrt(n) + 1.0), (y1 - y0) / (std::sqrt(n) + 1.0)});
  const int nx = static_cast<int>((x1 - x0) / width) + 1, ny = static_cast<int>((y1 - y0) / width) + 1;
  bucket_start_.assign(nx * ny + 1, 0);
  bucket_of_.resize(n);
  bucket_cells_.resize(n);
  for (int c = 0; c < n; ++c) {
    bucket_of_[c] = static_cast<int>((boxes_[c].x0 - x0) / width) + nx * static_cast<int>((boxes_[c].y0 - y0) / width);
    ++bucket_start_[bucket_of_[c] + 1];
  }
  for (int k = 0; k < nx * ny; ++k) bucket_start_[k + 1] += bucket_start_[k];
  neighbor_start_.assign(bucket_start_.begin(), bucket_start_.end() - 1);  // fill cursors
  for (int c = 0; c < n; ++c) bucket_cells_[neighbor_start_[bucket_of_[c]]++] = c;

  neighbors_.clear();
  neighbor_start_.assign(1, 0);
  for (int c = 0; c < n; ++c) {
    const Box& a = boxes_[c];
    const int bx = bucket_of_[c] % nx, by = bucket_of_[c] / nx;
    for (int j = std::max(by - 1, 0); j <= std::min(by + 1, ny - 1); ++j)
      for (int i = std::max(bx - 1, 0); i <= std::min(bx + 1, nx - 1); ++i)
        for (int k = bucket_start_[i + nx * j]; k < bucket_start_[i + nx * j + 1]; ++k) {
          const int other = bucket_cells_[k];
          const Box& b = boxes_[other];
          if (other != c && b.x0 < a.x1 + margin && b.x1 > a.x0 - margin && b.y0 < a.y1 + margin && b.y1 > a.y0 - margin)
            neighbors_.push_back(other);
        }
    std::sort(neighbors_.begin() + neighbor_start_.back(), neighbors_.end());
    neighbor_start_.push_back(static_cast<int>(neighbors_.size()));
  }
}

void ContactList::add_windows(const kernels::Shell& shell, const kernels::Table& kernel, int cell, int slot) {
  const double margin = reach_ + skin_, px = shell.x[slot], py = shell.y[slot];
  for (int k = neighbor_start_[cell]; k < neighbor_start_[cell + 1]; ++k) {
    const int other = neighbors_[k];
    const Box& b = boxes_[other];
    if (px < b.x0 - margin || px > b.x1 + margin || py < b.y0 - margin || py > b.y1 + margin) continue;
    kernel.near_segments(shell, other, px, py, margin * margin, words_.data());
    cut_windows(slot, shell.base[other] + 1, shell.count[other]);
  }
}

/// Windows over the near segments of one cell, from the bits of words_. Numbering is cyclic: a run that goes over the end
/// is taken up at its beginning, so that it is not cut there.
void ContactList::cut_windows(int slot, int first_slot, int n) {
  near_.clear();
  for (int w = 0; 64 * w < n; ++w)
    for (unsigned long long word = words_[w]; word != 0; word &= word - 1) near_.push_back(64 * w + __builtin_ctzll(word));
  const int count = static_cast<int>(near_.size());
  if (count == 0) return;
  int lead = 0;  // where the run over the end begins in near_
  if (near_.front() == 0 && near_.back() == n - 1)
    for (lead = count - 1; lead > 1 && near_[lead - 1] == near_[lead] - 1;) --lead;
  const auto ordered = [&](int k) { return near_[lead + k < count ? lead + k : lead + k - count]; };
  for (int k = 0; k < count;) {
    const int first = ordered(k);
    int length = 1;
    for (++k; k < count; ++k) {
      const int next = ordered(k), ahead = next >= first ? next - first : next + n - first;
      if (ahead >= kernels::window_segments) break;
      length = ahead + 1;
    }
    windows_.push_back({slot, first_slot + first, length});
  }
}

void ContactList::add_self_pairs(const kernels::Shell& shell, int cell) {
  const int b = shell.base[cell] + 1, n = shell.count[cell];
  const double reach = self_reach_ + skin_;
  for (int i = 0; i < n; ++i)
    for (int j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const double dx = shell.x[b + i] - shell.x[b + j], dy = shell.y[b + i] - shell.y[b + j];
      if (dx * dx + dy * dy < reach * reach) self_pairs_.push_back({b + i, b + j});
    }
}

}  // namespace suture
