#include "integrate/fused_nvector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kernels/aligned_buffer.hpp"

namespace suture {

namespace {

struct Content {
  Content(std::size_t n, std::shared_ptr<VectorFamily> in) : family(std::move(in)) { allocate(n); }
  void allocate(std::size_t n) {
    size = n;
    padded = (n + 7) / 8 * 8;
    buffer = AlignedBuffer(padded);
    data = buffer.data();
  }
  std::size_t size = 0, padded = 0;
  AlignedBuffer buffer;
  double* data = nullptr;
  std::shared_ptr<VectorFamily> family;
};

Content& content(N_Vector v) { return *static_cast<Content*>(v->content); }
/// What is there when all that was asked for is done.
double* data(N_Vector v) {
  content(v).family->settle();
  return content(v).data;
}
std::size_t padded(N_Vector v) { return content(v).padded; }
const VectorOperations& operations(N_Vector v) { return content(v).family->operations; }

template <class F>
void each(N_Vector z, F f) {
  operations(z).for_each_range(content(z).size, [f, out = data(z)](Range r) {
    const F own = f;
    for (std::size_t k = r.begin; k < r.end; ++k) out[k] = own(k);
  });
}

N_Vector clone(N_Vector v) { return make_fused_vector(content(v).size, v->sunctx, content(v).family); }

void destroy(N_Vector v) {
  content(v).family->settle();
  std::erase(content(v).family->members, v);
  delete static_cast<Content*>(v->content);
  v->content = nullptr;
  N_VFreeEmpty(v);
}

/// Of members of one family it may wait.
void add(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
  VectorFamily& family = *content(z).family;
  bool others = false;
  for (N_Vector v : {x, y})
    if (v != nullptr && content(v).family.get() != &family) others = true, content(v).family->settle();
  family.add({a, content(x).data, b, y != nullptr ? content(y).data : nullptr, content(z).data}, padded(z));
  if (others) family.settle();
}

void fill_standard_operations(N_Vector_Ops ops) {
  ops->nvlinearsum = add;
  ops->nvconst = [](double c, N_Vector z) { each(z, [c](auto) { return c; }); };
  ops->nvprod = [](N_Vector x, N_Vector y, N_Vector z) { each(z, [a = data(x), b = data(y)](auto k) { return a[k] * b[k]; }); };
  ops->nvdiv = [](N_Vector x, N_Vector y, N_Vector z) { each(z, [a = data(x), b = data(y)](auto k) { return a[k] / b[k]; }); };
  ops->nvscale = [](double c, N_Vector x, N_Vector z) { add(c, x, 0.0, nullptr, z); };
  ops->nvabs = [](N_Vector x, N_Vector z) { each(z, [a = data(x)](auto k) { return std::abs(a[k]); }); };
  ops->nvinv = [](N_Vector x, N_Vector z) { each(z, [a = data(x)](auto k) { return 1.0 / a[k]; }); };
  ops->nvaddconst = [](N_Vector x, double b, N_Vector z) { each(z, [a = data(x), b](auto k) { return a[k] + b; }); };
  ops->nvdotprod = [](N_Vector x, N_Vector y) { return operations(x).dot(padded(x), data(x), data(y)); };
  ops->nvmaxnorm = [](N_Vector x) {
    double m = 0.0;
    for (const double a : values(x)) m = std::max(m, std::abs(a));
    return m;
  };
  ops->nvwrmsnorm = [](N_Vector x, N_Vector w) {
    return std::sqrt(operations(x).weighted_square_sum(padded(x), data(x), data(w)) / static_cast<double>(content(x).size));
  };
}

constexpr int most_vectors = VectorOperations::most_vectors;

std::array<double*, most_vectors> pointers(int count, N_Vector* x) {
  std::array<double*, most_vectors> p{};
  for (int j = 0; j < count; ++j) p[j] = data(x[j]);
  return p;
}

void fill_fused_operations(N_Vector_Ops ops) {
  ops->nvlinearcombination = [](int count, double* c, N_Vector* x, N_Vector z) {
    if (count > most_vectors) return -1;
    operations(z).linear_combination(padded(z), count, c, pointers(count, x).data(), data(z));
    return 0;
  };
  ops->nvscaleaddmulti = [](int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
    if (count > most_vectors) return -1;
    operations(x).scale_add_multi(padded(x), count, a, data(x), pointers(count, y).data(), pointers(count, z).data());
    return 0;
  };
}

}  // namespace

N_Vector make_fused_vector(std::size_t n, SUNContext context, std::shared_ptr<VectorFamily> family) {
  N_Vector v = N_VNewEmpty(context);
  if (v == nullptr) throw std::bad_alloc();
  family->members.push_back(v);
  v->content = new Content(n, std::move(family));
  v->ops->nvgetvectorid = [](N_Vector) { return SUNDIALS_NVEC_CUSTOM; };
  v->ops->nvclone = clone;
  v->ops->nvdestroy = destroy;
  v->ops->nvgetarraypointer = [](N_Vector a) { return data(a); };
  v->ops->nvgetlength = [](N_Vector a) { return static_cast<sunindextype>(content(a).size); };
  fill_standard_operations(v->ops);
  fill_fused_operations(v->ops);
  return v;
}

std::span<double> values(N_Vector v) { return {data(v), content(v).size}; }

void VectorFamily::add(const LinearSum& sum, std::size_t padded_size) {
  if (waiting_.size() == most_waiting) settle();
  waiting_.push_back(sum);
  padded_size_ = padded_size;
}

void VectorFamily::settle() {
  if (waiting_.empty()) return;
  operations.linear_sums(padded_size_, waiting_);
  waiting_.clear();
}

void VectorFamily::rearrange(std::span<const int> source) {
  settle();
  struct Run {
    std::size_t to;
    int from;
    std::size_t length;
  };
  std::vector<Run> runs;  // few: an event inserts or drops points of the ring
  for (std::size_t k = 0; k < source.size(); ++k)
    if (k > 0 && source[k] == source[k - 1] + 1)
      ++runs.back().length;
    else
      runs.push_back({k, source[k], 1});
  for (N_Vector v : members) {
    Content& c = content(v);
    const bool unused = std::all_of(c.data, c.data + c.size, [](double a) { return a == 0.0; });  // needs no memory, then
    AlignedBuffer before = std::move(c.buffer);
    c.allocate(source.size());
    if (unused) continue;
    for (const Run& run : runs) std::copy_n(before.data() + run.from, run.length, c.data + run.to);
  }
}

}  // namespace suture
