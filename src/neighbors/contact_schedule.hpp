// How the contacts of a large tissue are shared out. Cells are cut into blocks of consecutive numbers and blocks into parts. A
// list belongs to each block, of the contacts inside one part whose later cell is in that block, and to each ordered pair of
// parts, of vertices of the first against segments of the second.
//
// Parts can be worked on at once, and so can pairs of parts that have no part in common; pairs come in rounds of such. Every sum
// has one order, whoever works. Within a part, list b touches blocks up to b only: what is needed of a block may be made just
// before its list, while its arrays are in the cache. That pays when neighbours have close numbers; no result depends on it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "threads/ranges.hpp"
#include "threads/worker_pool.hpp"

namespace suture {

class ContactSchedule {
 public:
  /// cells_per_block: 0 for one block.
  void divide(int cells, int cells_per_block);
  /// Puts the pairs of parts s < t for which have_contacts(s, t) into rounds.
  template <class HaveContacts>
  void arrange(const HaveContacts& have_contacts) {
    pairs_.clear();
    for (int s = 0; s < parts(); ++s)
      for (int t = s + 1; t < parts(); ++t)
        if (have_contacts(s, t)) pairs_.push_back({s, t, 0});
    number_rounds();
  }

  int parts() const { return parts_.count(); }
  int blocks() const { return blocks_.count(); }
  int lists() const { return blocks() + parts() * parts(); }
  Range cells_of(int block) const { return blocks_[block]; }
  int block_of(int cell) const { return cell / static_cast<int>(blocks_.length); }
  Range blocks_of(int part) const { return parts_[part]; }
  /// List of the vertices of part s against segments of part t, another one.
  int list_between(int s, int t) const { return blocks() + s * parts() + t; }
  /// List of the vertices of `cell` against segments of `other`.
  int list_of(int cell, int other) const {
    const int a = block_of(cell), b = block_of(other);
    const int s = a / static_cast<int>(parts_.length), t = b / static_cast<int>(parts_.length);
    return s == t ? std::max(a, b) : list_between(s, t);
  }

  struct Pair {
    int first, second, round;
  };
  /// Of parts, by rounds.
  std::span<const Pair> pairs() const { return pairs_; }

  /// task(list), for lists that touch no common cell at once; those of the blocks come first, within a part in their order.
  template <class Task>
  void for_each_list(WorkerPool& workers, const Task& task) const {
    workers.for_each(parts(), [&](int part) {
      const Range blocks = blocks_of(part);
      for (std::size_t b = blocks.begin; b < blocks.end; ++b) task(static_cast<int>(b));
    });
    for (std::size_t begin = 0, end; begin < pairs_.size(); begin = end) {
      for (end = begin; end < pairs_.size() && pairs_[end].round == pairs_[begin].round;) ++end;
      workers.for_each(static_cast<int>(end - begin), [&](int k) {
        const Pair& pair = pairs_[begin + k];
        task(list_between(pair.first, pair.second));
        task(list_between(pair.second, pair.first));
      });
    }
  }

 private:
  void number_rounds();

  Ranges blocks_{1, 1}, parts_{1, 1};  // of cells, of blocks
  std::vector<Pair> pairs_;
  std::vector<std::uint64_t> taken_;  // per round: bits of its parts
};

}  // namespace suture
