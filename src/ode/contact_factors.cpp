#include "ode/contact_factors.hpp"

#include <algorithm>

namespace suture {

void ContactFactors::linearise(const ContactList& list, const kernels::Shell& shell, const kernels::ContactScalars& contact,
                               const kernels::Table& kernel, WorkerPool& workers) {
  constexpr std::size_t chunk = kernels::WindowGroup::windows;  // few windows have all terms: memory for one group of such
  schedule_ = list.schedule();
  lists_.resize(schedule_.lists());
  workers.for_each(schedule_.lists(), [&](int k) {
    const ContactList::Entries& listed = list.entries(k);
    Live& here = lists_[k];
    here.live = 0;
    for (std::size_t w = 0, windows = list.active(k); w < windows; w += chunk) {
      here.make_room(kernels::window_terms * chunk);
      here.live += kernel.contact_linearise(shell, contact, listed.groups.data() + w / chunk, std::min(chunk, windows - w), nullptr, 0,
                                            here.factors.data() + here.live);
    }
    here.make_room(listed.self_pairs.size());
    here.live += kernel.contact_linearise(shell, contact, nullptr, 0, listed.self_pairs.data(), listed.self_pairs.size(),
                                          here.factors.data() + here.live);
  });
}

}  // namespace suture
