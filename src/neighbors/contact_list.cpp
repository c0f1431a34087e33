#include "neighbors/contact_list.hpp"

#include <algorithm>
#include <cmath>

#include "threads/ranges.hpp"

namespace suture {

void ContactList::build(const kernels::Shell& shell, const kernels::Table& kernel, WorkerPool& workers) {
  find_boxes(shell, workers);
  fill_buckets();
  schedule_.divide(shell.cells, cells_per_block_);
  lists_.resize(schedule_.lists());
  scratch_.resize(schedule_.parts());
  workers.for_each(schedule_.parts(), [&](int part) { fill_part(part, shell, kernel); });
  schedule_.arrange([this](int s, int t) {
    return !lists_[schedule_.list_between(s, t)].windows.empty() ||
           !lists_[schedule_.list_between(t, s)].windows.empty();
  });
  workers.for_each(schedule_.lists(), [&](int k) { lists_[k].groups.assign(lists_[k].windows); });
  active_bands_ = 1;
  age(0.0);
}

void ContactList::age(double moved) {
  const int wanted =
      skin_ > 0.0 ? std::min(1 + static_cast<int>(std::ceil(2.0 * moved / skin_ * (bands - 1))), bands) : bands;
  active_bands_ = std::max(active_bands_, wanted);
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

void ContactList::fill_part(int part, const kernels::Shell& shell, const kernels::Table& kernel) {
  Scratch& scratch = scratch_[part];
  const auto clear = [](Entries& entries) { entries.windows.clear(), entries.self_pairs.clear(); };
  const Range blocks = schedule_.blocks_of(part);
  for (std::size_t block = blocks.begin; block < blocks.end; ++block) clear(lists_[block]);
  for (int other = 0; other < schedule_.parts(); ++other) clear(lists_[schedule_.list_between(part, other)]);
  for (std::size_t block = blocks.begin; block < blocks.end; ++block)
    for (std::size_t k = schedule_.cells_of(static_cast<int>(block)).begin;
         k < schedule_.cells_of(static_cast<int>(block)).end; ++k) {
      const auto c = static_cast<int>(k);
      find_neighbors(c, scratch.neighbors);
      for (int slot = shell.base[c] + 1; slot <= shell.base[c] + shell.count[c]; ++slot)
        add_windows(scratch, shell, kernel, slot);
      if (self_reach_ > 0.0) add_self_pairs(lists_[block], shell, c);
    }
}

/// Cells whose boxes come within reach + skin, ascending.
void ContactList::find_neighbors(int cell, std::vector<Neighbor>& neighbors) const {
  const double margin = reach_ + skin_;
  const Box& a = boxes_[cell];
  const int bx = bucket_of_[cell] % nx_, by = bucket_of_[cell] / nx_;
  neighbors.clear();
  for (int j = std::max(by - 1, 0); j <= std::min(by + 1, ny_ - 1); ++j)
    for (int i = std::max(bx - 1, 0); i <= std::min(bx + 1, nx_ - 1); ++i)
      for (int k = bucket_start_[i + nx_ * j]; k < bucket_start_[i + nx_ * j + 1]; ++k) {
        const int other = bucket_cells_[k];
        const Box& b = boxes_[other];
        if (other != cell && b.x0 < a.x1 + margin && b.x1 > a.x0 - margin && b.y0 < a.y1 + margin &&
            b.y1 > a.y0 - margin)
          neighbors.push_back({other, schedule_.list_of(cell, other)});
      }
  std::sort(neighbors.begin(), neighbors.end(),
            [](const Neighbor& one, const Neighbor& two) { return one.cell < two.cell; });
}

void ContactList::add_windows(Scratch& scratch, const kernels::Shell& shell, const kernels::Table& kernel, int slot) {
  const double margin = reach_ + skin_, px = shell.x[slot], py = shell.y[slot];
  for (const auto& [other, list] : scratch.neighbors) {
    const Box& b = boxes_[other];
    if (px < b.x0 - margin || px > b.x1 + margin || py < b.y0 - margin || py > b.y1 + margin) continue;
    const int n = shell.count[other];
    scratch.words.resize(std::max<std::size_t>(scratch.words.size(), (n + 63) / 64));
    scratch.distance2.resize(std::max<std::size_t>(scratch.distance2.size(), (n + 7) / 8 * 8));
    kernel.near_segments(shell, other, px, py, margin * margin, scratch.words.data(), scratch.distance2.data());
    cut_windows(scratch, slot, shell.base[other] + 1, n, lists_[list].windows);
  }
}

/// Windows over the near segments of one cell, from the bits of words. Numbering is cyclic: a run that goes over the end
/// is taken up at its beginning, so that it is not cut there.
void ContactList::cut_windows(Scratch& scratch, int slot, int first_slot, int n,
                              std::vector<kernels::Window>& windows) const {
  std::vector<int>& near = scratch.near;
  near.clear();
  for (int w = 0; 64 * w < n; ++w)
    for (unsigned long long word = scratch.words[w]; word != 0; word &= word - 1)
      near.push_back(64 * w + __builtin_ctzll(word));
  const int count = static_cast<int>(near.size());
  if (count == 0) return;
  if (near.front() == 0 && near.back() == n - 1 && count < n) {
    int lead = count - 1;  // where the run over the end begins
    while (near[lead - 1] == near[lead] - 1) --lead;
    std::rotate(near.begin(), near.begin() + lead, near.end());
  }
  for (int begin = 0, end = 0; begin < count; begin = end) {
    for (end = begin + 1; end < count && near[end] == (near[end - 1] + 1) % n;) ++end;
    cut_run({near.data() + begin, near.data() + end}, scratch, slot, first_slot, windows);
  }
}

/// Windows over consecutive segments. The nearest is the middle of one: what is in reach lies beside it, and at a cut in
/// reach the windows on either side would have a term each that cancel.
void ContactList::cut_run(std::span<const int> run, const Scratch& scratch, int slot, int first_slot,
                          std::vector<kernels::Window>& windows) const {
  constexpr int most = kernels::window_segments;
  const std::vector<double>& distance2 = scratch.distance2;
  const auto nearer = [&](int one, int two) { return distance2[one] < distance2[two]; };
  const auto nearest = static_cast<int>(std::min_element(run.begin(), run.end(), nearer) - run.begin());
  const auto length = static_cast<int>(run.size());
  const int phase = (nearest - most / 2 + most) % most;
  for (int k = phase == 0 ? 0 : phase - most; k < length; k += most) {
    const int begin = std::max(k, 0), end = std::min(k + most, length);
    const int closest = *std::min_element(run.begin() + begin, run.begin() + end, nearer);
    windows.push_back({slot, first_slot + run[begin], static_cast<std::int16_t>(end - begin),
                       static_cast<std::int16_t>(band_of(distance2[closest]))});
  }
}

void ContactList::add_self_pairs(Entries& entries, const kernels::Shell& shell, int cell) const {
  const int b = shell.base[cell] + 1, n = shell.count[cell];
  const double reach = self_reach_ + skin_;
  for (int i = 0; i < n; ++i)
    for (int j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const double dx = shell.x[b + i] - shell.x[b + j], dy = shell.y[b + i] - shell.y[b + j];
      if (dx * dx + dy * dy < reach * reach) entries.self_pairs.push_back({b + i, b + j});
    }
}

}  // namespace suture
