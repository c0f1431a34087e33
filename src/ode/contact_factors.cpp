#include "ode/contact_factors.hpp"

#include <algorithm>

namespace suture {

void ContactFactors::linearise(const ContactList& list, const kernels::Shell& shell, const kernels::ContactScalars& contact,
                               double lowest, const kernels::Table& kernel, WorkerPool& workers) {
  // Few windows are fully live, so memory is not asked for as if all were. Even: the kernel works on pairs.
  constexpr std::size_t chunk = 64;
  schedule_ = list.schedule();
  lists_.resize(schedule_.lists());
  workers.for_each(schedule_.lists(), [&](int k) {
    const ContactList::Entries& listed = list.entries(k);
    Live& here = lists_[k];
    here.live = 0;
    for (std::size_t w = 0; w < listed.windows.size(); w += chunk) {
      const std::size_t count = std::min(chunk, listed.windows.size() - w);
      here.make_room(8 * chunk);
      here.live += kernel.contact_linearise(shell, contact, listed.windows.data() + w, count, nullptr, 0, lowest,
                                            here.factors.data() + here.live);
    }
    here.make_room(listed.self_pairs.size());
    here.live += kernel.contact_linearise(shell, contact, nullptr, 0, listed.self_pairs.data(), listed.self_pairs.size(), lowest,
                                          here.factors.data() + here.live);
  });
}

}  // namespace suture
