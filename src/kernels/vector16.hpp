// Sixteen floats as one value, for what needs no more digits: one AVX-512 register, two of AVX2, four of SSE2.
#pragma once

#include "kernels/vector8.hpp"

namespace {

constexpr int float_lanes = 16;

typedef float NativeFloat __attribute__((vector_size(width * 8)));
typedef float UnalignedNativeFloat __attribute__((vector_size(width * 8), aligned(4), may_alias));

struct Float16 {
  NativeFloat r[registers];
};

SUTURE_INLINE Float16 load(const float* p) {
  Float16 a;
  for (int i = 0; i < registers; ++i) a.r[i] = *reinterpret_cast<const UnalignedNativeFloat*>(p + 2 * i * width);
  return a;
}
SUTURE_INLINE void store(float* p, Float16 a) {
  for (int i = 0; i < registers; ++i) *reinterpret_cast<UnalignedNativeFloat*>(p + 2 * i * width) = a.r[i];
}

#define SUTURE_OPERATOR(op)                                        \
  SUTURE_INLINE Float16 operator op(Float16 a, Float16 b) {        \
    for (int i = 0; i < registers; ++i) a.r[i] = a.r[i] op b.r[i]; \
    return a;                                                      \
  }                                                                \
  SUTURE_INLINE Float16& operator op##=(Float16& a, Float16 b) { return a = a op b; }
SUTURE_OPERATOR(+)
SUTURE_OPERATOR(-)
SUTURE_OPERATOR(*)
#undef SUTURE_OPERATOR

/// Eight doubles at `to`, rounded.
SUTURE_INLINE void store_narrow(float* to, Double8 a) {
  typedef float Half __attribute__((vector_size(width * 4)));
  typedef float UnalignedHalf __attribute__((vector_size(width * 4), aligned(4), may_alias));
  for (int i = 0; i < registers; ++i) *reinterpret_cast<UnalignedHalf*>(to + i * width) = __builtin_convertvector(a.r[i], Half);
}

#if defined(__AVX512F__)
/// Sixteen doubles, rounded.
SUTURE_INLINE Float16 load_narrow(const double* p) {
  const __m256 low = _mm512_cvtpd_ps(_mm512_loadu_pd(p)), high = _mm512_cvtpd_ps(_mm512_loadu_pd(p + lanes));
  return {{_mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1)}};
}
SUTURE_INLINE void store_wide(double* p, Float16 a) {
  _mm512_storeu_pd(p, _mm512_cvtps_pd(_mm512_castps512_ps256(a.r[0])));
  _mm512_storeu_pd(p + lanes, _mm512_cvtps_pd(_mm512_extractf32x8_ps(a.r[0], 1)));
}
/// Lane j of row i goes to lane i of row j. Taking rows i and i + 8 turn about rotates the bits of (row, lane) by one; four
/// times exchanges the two.
SUTURE_INLINE void transpose(Float16 (&rows)[float_lanes]) {
  const __m512i low = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
  const __m512i high = _mm512_setr_epi32(8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
  for (int bit = 0; bit < 4; ++bit) {
    Float16 next[float_lanes];
    for (int i = 0; i < float_lanes / 2; ++i) {
      next[2 * i].r[0] = _mm512_permutex2var_ps(rows[i].r[0], low, rows[i + float_lanes / 2].r[0]);
      next[2 * i + 1].r[0] = _mm512_permutex2var_ps(rows[i].r[0], high, rows[i + float_lanes / 2].r[0]);
    }
    for (int i = 0; i < float_lanes; ++i) rows[i] = next[i];
  }
}
#endif

}  // namespace
