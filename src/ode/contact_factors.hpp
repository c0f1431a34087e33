// The contact energy's second derivatives at one linearisation: the repulsive terms of every list of contacts.
#pragma once

#include <span>
#include <vector>

#include "kernels/kernels.hpp"
#include "neighbors/contact_list.hpp"
#include "threads/worker_pool.hpp"

namespace suture {

class ContactFactors {
 public:
  void linearise(const ContactList& list, const kernels::Shell& shell, const kernels::ContactScalars& contact,
                 const kernels::Table& kernel, WorkerPool& workers);
  /// task(list, span of factors), as ContactSchedule::for_each_list.
  template <class Task>
  void for_each_list(WorkerPool& workers, const Task& task) const {
    schedule_.for_each_list(workers, [&](int k) { task(k, std::span(lists_[k].factors.data(), lists_[k].live)); });
  }

  /// visit(factor), one after the other.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Live& list : lists_)
      for (std::size_t k = 0; k < list.live; ++k) visit(list.factors[k]);
  }

 private:
  struct Live {
    std::vector<kernels::ContactFactor> factors;  // the first `live` are in use
    std::size_t live = 0;
    /// Grows by an eighth, not twofold: lists are made once and used often.
    void make_room(std::size_t more) {
      const std::size_t needed = live + more;
      if (factors.capacity() < needed) factors.reserve(needed + needed / 8);
      if (factors.size() < needed) factors.resize(needed);
    }
  };
  std::vector<Live> lists_;
  ContactSchedule schedule_;  // of the list at the linearisation: it may have been rebuilt since
};

}  // namespace suture
