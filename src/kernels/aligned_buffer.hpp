// One 64-byte aligned allocation handed out in pieces, so that a tissue's arrays sit together and are freed together.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

namespace suture {

class AlignedBuffer {
 public:
  AlignedBuffer() = default;
  explicit AlignedBuffer(std::size_t doubles) : size_((doubles + 7) / 8 * 8) {
    // calloc hands out pages of a large buffer untouched: arrays that are never used take no memory.
    memory_.reset(static_cast<char*>(std::calloc(size_ * sizeof(double) + 2 * line, 1)));
    if (memory_ == nullptr) throw std::bad_alloc();
    const auto address = reinterpret_cast<std::uintptr_t>(memory_.get());
    data_ = reinterpret_cast<double*>((address + line - 1) / line * line);
  }
  AlignedBuffer(AlignedBuffer&& other) noexcept { *this = std::move(other); }
  AlignedBuffer& operator=(AlignedBuffer&& other) noexcept {
    memory_ = std::move(other.memory_);
    data_ = std::exchange(other.data_, nullptr);
    size_ = std::exchange(other.size_, 0);
    used_ = std::exchange(other.used_, 0);
    return *this;
  }
  double* data() const { return data_; }
  /// The next `doubles` values, rounded up to whole cache lines.
  double* take(std::size_t doubles) {
    double* p = data_ + used_;
    used_ += (doubles + 7) / 8 * 8;
    return p;
  }

 private:
  static constexpr std::size_t line = 64;
  struct Free {
    void operator()(char* p) const { std::free(p); }
  };
  std::unique_ptr<char, Free> memory_;
  double* data_ = nullptr;
  std::size_t size_ = 0, used_ = 0;
};

}  // namespace suture
