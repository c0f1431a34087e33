// The contact energy's second derivatives at one linearisation: the live terms of every tile of the contact list.
#pragma once

#include <span>
#include <vector>

#include "kernels/kernels.hpp"
#include "neighbors/contact_list.hpp"
#include "threads/worker_pool.hpp"

namespace suture {

class ContactFactors {
 public:
  /// lowest: curvatures below it are replaced by it.
  void linearise(const ContactList& list, const kernels::Shell& shell, const kernels::ContactScalars& contact, double lowest,
                 const kernels::Table& kernel, WorkerPool& workers);
  /// (ox, oy) += H_contact (vx, vy) in the padded arrays of `hessian`.
  void add_product(const kernels::ShellHessian& hessian, const kernels::Table& kernel, WorkerPool& workers) const;

  /// task(span of factors), for tiles that touch no common cell at once; in a fixed order for every cell.
  template <class Task>
  void for_each_tile(WorkerPool& workers, const Task& task) const {
    colours_.for_each_tile(workers, [&](int k) { task(std::span(tiles_[k].factors.data(), tiles_[k].live)); });
  }

  /// visit(factor), one after the other.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Tile& tile : tiles_)
      for (std::size_t k = 0; k < tile.live; ++k) visit(tile.factors[k]);
  }

 private:
  struct Tile {
    std::vector<kernels::ContactFactor> factors;  // the first `live` are in use
    std::size_t live = 0;
    void make_room(std::size_t more) {
      if (factors.size() < live + more) factors.resize(live + more);
    }
  };
  std::vector<Tile> tiles_;
  TileColours colours_;  // of the list at the linearisation: it may have been rebuilt since
};

}  // namespace suture
