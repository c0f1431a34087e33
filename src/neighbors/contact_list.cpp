#include "neighbors/contact_list.hpp"

#include <algorithm>
#include <cmath>

#include "threads/ranges.hpp"

namespace suture {

namespace {

template <class T>
T* grow(std::vector<T>& room, std::size_t size) {
  if (room.size() < size) room.resize(size);
  return room.data();
}

}  // namespace

void ContactList::build(const kernels::Shell& shell, const kernels::Table& kernel, WorkerPool& workers) {
  find_boxes(shell, kernel, workers);
  fill_buckets();
  schedule_.divide(shell.cells, cells_per_block_);
  lists_.resize(schedule_.lists());
  scratch_.resize(schedule_.parts());
  workers.for_each(schedule_.parts(), [&](int part) { fill_part(part, shell, kernel); });
  schedule_.arrange([this](int s, int t) {
    return !lists_[schedule_.list_between(s, t)].windows.empty() ||
           !lists_[schedule_.list_between(t, s)].windows.empty();
  });
  workers.for_each(schedule_.lists(), [&](int k) {
    lists_[k].groups.assign(lists_[k].windows);
    age(k, 0.0);
  });
  note_completions();
}

void ContactList::find_boxes(const kernels::Shell& shell, const kernels::Table& kernel, WorkerPool& workers) {
  const double margin = std::max(reach_, self_reach_) + skin_;
  boxes_.resize(shell.cells);
  first_segment_box_.resize(shell.cells + 1);
  for (int c = 0; c < shell.cells; ++c) first_segment_box_[c + 1] = first_segment_box_[c] + (shell.count[c] + 7) / 8;
  const std::size_t room = first_segment_box_.back() + 8;  // they are loaded eight at a time
  segment_box_room_.resize(4 * room);
  double* const room_begin = segment_box_room_.data();
  segment_boxes_ = {room_begin, room_begin + room, room_begin + 2 * room, room_begin + 3 * room};
  const Ranges ranges{boxes_.size(), 256};
  workers.for_each(ranges.count(), [&](int k) {
    for (std::size_t c = ranges[k].begin; c < ranges[k].end; ++c)
      kernel.segment_boxes(shell, static_cast<int>(c), margin, segment_boxes_, first_segment_box_[c], &boxes_[c].x0);
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
  const auto clear = [](Entries& entries) { entries.windows.clear(), entries.self_pairs.clear(), entries.blocks.clear(); };
  const Range blocks = schedule_.blocks_of(part);
  for (std::size_t block = blocks.begin; block < blocks.end; ++block) clear(lists_[block]);
  for (int other = 0; other < schedule_.parts(); ++other) clear(lists_[schedule_.list_between(part, other)]);
  for (std::size_t block = blocks.begin; block < blocks.end; ++block)
    for (std::size_t k = schedule_.cells_of(static_cast<int>(block)).begin;
         k < schedule_.cells_of(static_cast<int>(block)).end; ++k) {
      const auto c = static_cast<int>(k);
      find_neighbors(c, scratch.neighbors);
      note_blocks(c, scratch.neighbors);
      add_windows(scratch, shell, kernel, c);
      if (self_reach_ > 0.0) add_self_pairs(scratch, lists_[block], shell, kernel, c);
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

void ContactList::note_blocks(int cell, const std::vector<Neighbor>& neighbors) {
  const auto note = [](std::vector<int>& blocks, int block) {
    if (std::find(blocks.begin(), blocks.end(), block) == blocks.end()) blocks.push_back(block);
  };
  for (const Neighbor& neighbor : neighbors)
    for (const int c : {cell, neighbor.cell}) note(lists_[neighbor.list].blocks, schedule_.block_of(c));
}

void ContactList::note_completions() {
  last_list_.assign(schedule_.blocks(), 0);
  schedule_.for_each_list(WorkerPool::alone(), [this](int k) {
    lists_[k].completes.clear();
    if (k < schedule_.blocks()) last_list_[k] = k;
    for (const int block : lists_[k].blocks) last_list_[block] = k;
  });
  for (int block = 0; block < schedule_.blocks(); ++block) lists_[last_list_[block]].completes.push_back(block);
}

/// Scratch has room for what is found.
kernels::NearQuery ContactList::query_around(int cell, const kernels::Shell& shell, const kernels::Table& kernel, Scratch& scratch) const {
  std::size_t most = 0, boxes = 0;
  for (const Neighbor& neighbor : scratch.neighbors) {
    most = std::max<std::size_t>(most, shell.count[neighbor.cell]);
    boxes += (shell.count[neighbor.cell] + 7) / 8;
  }
  const double margin = reach_ + skin_;
  kernels::NearQuery query{.shell = shell, .near = {}, .reach2 = margin * margin};
  double edge = reach_;
  for (double& edge2 : query.edge2) edge2 = edge * edge, edge += skin_ / (bands - 1);
  double* const room = grow(scratch.box_room, 4 * (boxes + 8));
  query.near.boxes = {room, room + boxes + 8, room + 2 * (boxes + 8), room + 3 * (boxes + 8)};
  query.near.of = grow(scratch.box_of, boxes);
  for (std::size_t k = 0; k < scratch.neighbors.size(); ++k) {
    const int other = scratch.neighbors[k].cell;
    kernel.near_boxes(shell, &boxes_[cell].x0, segment_boxes_, first_segment_box_[other], other, static_cast<int>(k), query.near);
  }
  const std::size_t pairs = static_cast<std::size_t>(query.near.count) * kernels::NearQuery::vertices;
  query.rows = grow(scratch.rows, (query.near.count + 7) / 8);
  query.columns = grow(scratch.columns, (query.near.count + 7) / 8);
  query.found = grow(scratch.found, query.near.count + 1);
  query.bits = grow(scratch.bits, 2 * pairs + 9);
  query.groups = grow(scratch.groups, pairs + 1);
  query.segments = grow(scratch.segments, 2 * pairs + 1);
  query.numbers = grow(scratch.numbers, most);
  query.distance2 = grow(scratch.distance2, 24 * pairs + 16);
  query.runs = grow(scratch.runs, 4 * pairs + 1);
  grow(scratch.windows, 8 * pairs + 3);
  return query;
}

void ContactList::add_windows(Scratch& scratch, const kernels::Shell& shell, const kernels::Table& kernel, int cell) {
  const kernels::NearQuery query = query_around(cell, shell, kernel, scratch);
  const int first = shell.base[cell] + 1, end = first + shell.count[cell];
  for (int slot = first; slot < end; slot += query.vertices) {
    const int runs = kernel.near_windows(query, slot, std::min(end - slot, query.vertices), scratch.windows.data());
    const kernels::Window* window = scratch.windows.data();
    for (int k = 0; k < runs;) {
      const int list = scratch.neighbors[query.runs[k].cell].list;
      const kernels::Window* const begin = window;
      for (; k < runs && scratch.neighbors[query.runs[k].cell].list == list; ++k) window += query.runs[k].windows;
      lists_[list].windows.insert(lists_[list].windows.end(), begin, window);
    }
  }
}

/// The kernel looks a little farther, so that the pairs do not depend on how it rounds.
void ContactList::add_self_pairs(Scratch& scratch, Entries& entries, const kernels::Shell& shell, const kernels::Table& kernel, int cell) const {
  const int b = shell.base[cell] + 1, n = shell.count[cell];
  const double reach = self_reach_ + skin_;
  grow(scratch.rows, (n + 7) / 8);
  const auto add = [&](int i, int j) {
    const double dx = shell.x[b + i] - shell.x[b + j], dy = shell.y[b + i] - shell.y[b + j];
    if (dx * dx + dy * dy < reach * reach) entries.self_pairs.push_back({b + i, b + j});
  };
  for (int first = 0; first < n; first += 8)
    if (kernel.near_pairs(shell, cell, first, segment_boxes_, first_segment_box_[cell], 1.000001 * reach * reach, scratch.rows.data()))
      for (int i = 0; i < 8; ++i)
        for (int k = first / 8; 8 * k < n; ++k)
          for (std::uint64_t left = scratch.rows[k] >> 8 * i & 0xffu; left != 0; left &= left - 1) add(first + i, 8 * k + __builtin_ctzll(left));
}

}  // namespace suture
