// The kernels' vector operations on vectors that several threads may share: long ones are cut into fixed ranges, and sums
// are added range by range, so that the number of threads changes no bit. Any length n, as in kernels.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "kernels/kernels.hpp"
#include "threads/ranges.hpp"
#include "threads/worker_pool.hpp"

namespace suture {

/// z = a x + b y; z = a x without y. z may be x or y.
struct LinearSum {
  double a;
  const double* x;
  double b;
  const double* y;
  double* z;
};

class VectorOperations {
 public:
  static constexpr int most_vectors = 16;  ///< in one combination; CVODE combines at most 13 (Adams, order 12)

  explicit VectorOperations(WorkerPool& workers) : workers_(&workers), kernel_(&kernels::best()) {}

  /// visit(Range), for ranges that together are 0 .. n-1.
  template <class Visit>
  void for_each_range(std::size_t n, const Visit& visit) const {
    const Ranges ranges = vector_ranges(n);
    workers_->for_each(ranges.count(), [&](int k) { visit(ranges[k]); });
  }
  /// part(Range) of all ranges, put together by join(one, other) in their order.
  template <class Part, class Join>
  double reduce(std::size_t n, const Part& part, const Join& join) const {
    const Ranges ranges = vector_ranges(n);
    std::array<double, most_vector_ranges> parts;
    workers_->for_each(ranges.count(), [&](int k) { parts[k] = part(ranges[k]); });
    double total = ranges.count() > 0 ? parts[0] : 0.0;
    for (int k = 1; k < ranges.count(); ++k) total = join(total, parts[k]);
    return total;
  }
  template <class Part>
  double sum(std::size_t n, const Part& part) const {
    return reduce(n, part, [](double one, double other) { return one + other; });
  }

  double dot(std::size_t n, const double* x, const double* y) const {
    return sum(n, [&](Range r) { return kernel_->dot(r.end - r.begin, x + r.begin, y + r.begin); });
  }
  double weighted_square_sum(std::size_t n, const double* x, const double* w) const {
    return sum(n, [&](Range r) { return kernel_->weighted_square_sum(r.end - r.begin, x + r.begin, w + r.begin); });
  }
  /// z = x - y; returns p.z.
  double subtract_and_dot(std::size_t n, const double* x, const double* y, const double* p, double* z) const {
    return sum(n, [&](Range r) {
      return kernel_->subtract_and_dot(r.end - r.begin, x + r.begin, y + r.begin, p + r.begin, z + r.begin);
    });
  }
  /// z = x + y; returns the largest |y|.
  double add_and_largest(std::size_t n, const double* x, const double* y, double* z) const {
    const auto part = [&](Range r) { return kernel_->add_and_largest(r.end - r.begin, x + r.begin, y + r.begin, z + r.begin); };
    return reduce(n, part, [](double one, double other) { return std::max(one, other); });
  }
  /// y0 += a x0, y1 += a x1
  void add_scaled_twice(std::size_t n, double a, const double* x0, double* y0, const double* x1, double* y1) const {
    for_each_range(n, [&](Range r) {
      kernel_->add_scaled_twice(r.end - r.begin, a, x0 + r.begin, y0 + r.begin, x1 + r.begin, y1 + r.begin);
    });
  }
  void linear_sum(std::size_t n, double a, const double* x, double b, const double* y, double* z) const {
    for_each_range(n, [&](Range r) { kernel_->linear_sum(r.end - r.begin, a, x + r.begin, b, y + r.begin, z + r.begin); });
  }
  /// One after the other, but a piece of all vectors at a time that stays in the first-level cache.
  void linear_sums(std::size_t n, std::span<const LinearSum> sums) const {
    constexpr std::size_t piece = 512;
    const std::size_t length = sums.size() > 1 ? piece : std::max<std::size_t>(n, 1);
    for_each_range(n, [&](Range r) {
      for (std::size_t k = r.begin; k < r.end; k += length)
        for (const LinearSum& s : sums) add_up(s, k, std::min(length, r.end - k));
    });
  }
  /// count <= most_vectors, here and below.
  void linear_combination(std::size_t n, int count, const double* c, const double* const* x, double* z) const {
    for_each_range(n, [&](Range r) {
      kernel_->linear_combination(r.end - r.begin, count, c, shifted(count, x, r.begin).data(), z + r.begin);
    });
  }
  void scale_add_multi(std::size_t n, int count, const double* a, const double* x, const double* const* y, double* const* z) const {
    for_each_range(n, [&](Range r) {
      kernel_->scale_add_multi(r.end - r.begin, count, a, x + r.begin, shifted(count, y, r.begin).data(),
                               shifted(count, z, r.begin).data());
    });
  }

 private:
  void add_up(const LinearSum& s, std::size_t k, std::size_t n) const {
    const double* const x = s.x + k;
    if (s.y != nullptr)
      kernel_->linear_sum(n, s.a, x, s.b, s.y + k, s.z + k);
    else
      kernel_->linear_combination(n, 1, &s.a, &x, s.z + k);
  }
  template <class Pointer>
  static std::array<Pointer, most_vectors> shifted(int count, const Pointer* x, std::size_t by) {
    std::array<Pointer, most_vectors> p{};
    for (int j = 0; j < count; ++j) p[j] = x[j] + by;
    return p;
  }

  WorkerPool* workers_;
  const kernels::Table* kernel_;
};

}  // namespace suture
