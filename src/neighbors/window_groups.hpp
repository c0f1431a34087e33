// The windows of one list in the layout the contact kernels work on, nearer bands first.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/kernels.hpp"

namespace suture {

class WindowGroups {
 public:
  static constexpr int bands = kernels::window_bands;

  /// Within a band windows keep their order.
  void assign(std::span<const kernels::Window> windows) {
    end_.fill(0);
    for (const kernels::Window& window : windows) ++end_[window.band];
    std::array<std::size_t, bands> place{};
    for (int band = 1; band < bands; ++band) {
      place[band] = end_[band - 1];
      end_[band] += end_[band - 1];
    }
    groups_.resize((windows.size() + size - 1) / size);
    for (kernels::WindowGroup& group : groups_) std::fill_n(group.segments, kernels::window_segments, 0);
    for (const kernels::Window& window : windows) put(place[window.band]++, window);
    for (std::size_t k = windows.size(); k < groups_.size() * size; ++k) groups_[k / size].slots[k % size] = groups_[k / size].slots[0];
  }

  const kernels::WindowGroup* data() const { return groups_.data(); }
  /// How many windows the first `count` bands have.
  std::size_t windows(int count = bands) const { return end_[count - 1]; }

 private:
  static constexpr std::size_t size = kernels::WindowGroup::windows;
  void put(std::size_t at, const kernels::Window& window) {
    kernels::WindowGroup& group = groups_[at / size];
    group.slots[at % size] = {window.p, window.q};
    for (int k = 0; k < kernels::window_segments; ++k) group.segments[k] |= std::uint64_t{k < window.segments} << at % size;
  }

  std::vector<kernels::WindowGroup> groups_;
  std::array<std::size_t, bands> end_{};
};

}  // namespace suture
