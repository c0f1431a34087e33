// One 64-byte aligned allocation handed out in pieces, so that a tissue's arrays sit together and are freed together.
#pragma once

#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

namespace suture {

class AlignedBuffer {
 public:
  AlignedBuffer() = default;
  explicit AlignedBuffer(std::size_t doubles) : size_((doubles + 7) / 8 * 8) {
    void* p = std::aligned_alloc(64, size_ * sizeof(double) + 64);
    if (p == nullptr) throw std::bad_alloc();
    std::memset(p, 0, size_ * sizeof(double) + 64);
    data_.reset(static_cast<double*>(p));
  }
  double* data() const { return data_.get(); }
  /// The next `doubles` values, rounded up to whole cache lines.
  double* take(std::size_t doubles) {
    double* p = data_.get() + used_;
    used_ += (doubles + 7) / 8 * 8;
    return p;
  }

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::unique_ptr<double, Free> data_;
  std::size_t size_ = 0, used_ = 0;
};

}  // namespace suture
