#include "kernels/kernels.hpp"

namespace suture::kernels {

const Table& best() {
#if defined(SUTURE_SIMD_BASELINE)
  return baseline;
#elif defined(SUTURE_SIMD_AVX2)
  return avx2;
#elif defined(SUTURE_SIMD_AVX512)
  return avx512;
#else
  static const Table& chosen =
      __builtin_cpu_supports("x86-64-v4") ? avx512 : (__builtin_cpu_supports("x86-64-v3") ? avx2 : baseline);
  return chosen;
#endif
}

}  // namespace suture::kernels
