#include "ode/contact_factors.hpp"

#include <algorithm>

namespace suture {

void ContactFactors::linearise(const ContactList& list, const kernels::Shell& shell, const kernels::ContactScalars& contact,
                               double lowest, const kernels::Table& kernel, WorkerPool& workers) {
  // Few windows are fully live, so memory is not asked for as if all were. Even: the kernel works on pairs.
  constexpr std::size_t chunk = 64;
  colours_ = list.colours();
  tiles_.resize(std::max<std::size_t>(tiles_.size(), colours_.tiles()));
  workers.for_each(colours_.tiles(), [&](int k) {
    const ContactList::Tile& listed = list.tile(k);
    Tile& tile = tiles_[k];
    tile.live = 0;
    for (std::size_t w = 0; w < listed.windows.size(); w += chunk) {
      const std::size_t count = std::min(chunk, listed.windows.size() - w);
      tile.make_room(8 * chunk);
      tile.live += kernel.contact_linearise(shell, contact, listed.windows.data() + w, count, nullptr, 0, lowest,
                                            tile.factors.data() + tile.live);
    }
    tile.make_room(listed.self_pairs.size());
    tile.live += kernel.contact_linearise(shell, contact, nullptr, 0, listed.self_pairs.data(), listed.self_pairs.size(), lowest,
                                          tile.factors.data() + tile.live);
  });
}

void ContactFactors::add_product(const kernels::ShellHessian& hessian, const kernels::Table& kernel, WorkerPool& workers) const {
  for_each_tile(workers, [&](std::span<const kernels::ContactFactor> factors) {
    kernel.contact_product(factors.data(), factors.size(), hessian.vx, hessian.vy, hessian.ox, hessian.oy);
  });
}

}  // namespace suture
