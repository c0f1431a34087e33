// The lanes of the contact kernel: two windows of four lanes each, and live lanes packed one behind the other. Compiled
// once per instruction set, like vector8.hpp.
#pragma once

#include "kernels/vector8.hpp"

namespace {

/// Lanes 0-3 from p, lanes 4-7 from q.
SUTURE_INLINE Double8 load_halves(const double* p, const double* q) {
#if defined(__AVX512F__)
  return {{_mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(p)), _mm256_loadu_pd(q), 1)}};
#else
  Double8 a;
  for (int i = 0; i < registers; ++i)
    a.r[i] =
        *reinterpret_cast<const UnalignedNative*>(i < registers / 2 ? p + i * width : q + (i - registers / 2) * width);
  return a;
#endif
}
SUTURE_INLINE Double8 broadcast_halves(double p, double q) {
#if defined(__AVX512F__)
  return {{_mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_set1_pd(p)), _mm256_set1_pd(q), 1)}};
#else
  Double8 a;
  for (int i = 0; i < registers; ++i) {
    const double value = i < registers / 2 ? p : q;
#if defined(__AVX2__)
    a.r[i] = _mm256_set1_pd(value);
#else
    a.r[i] = _mm_set1_pd(value);
#endif
  }
  return a;
#endif
}
/// The bit patterns as integers, plus n.
SUTURE_INLINE Double8 add_bits(Double8 a, const long long* n) {
  typedef long long Bits __attribute__((vector_size(width * 8), may_alias));
  for (int i = 0; i < registers; ++i)
    a.r[i] = reinterpret_cast<Native>(reinterpret_cast<Bits>(a.r[i]) + *reinterpret_cast<const Bits*>(n + i * width));
  return a;
}
/// Lane k of each half receives lane k - 1 of it; its first lane receives zero.
#if defined(__AVX512F__) && defined(__AVX512DQ__)
SUTURE_INLINE Mask8 shift_up_halves(Mask8 a) { return from_bits((a.m << 1) & 0xee); }
#else
SUTURE_INLINE Mask8 shift_up_halves(Mask8 a) {
  Native r[registers];
  for (int i = 0; i < registers; ++i) r[i] = reinterpret_cast<Native>(a.m[i]);
#if defined(__AVX2__)
  for (Native& half : r) half = _mm256_blend_pd(_mm256_permute4x64_pd(half, 0x90), _mm256_setzero_pd(), 1);
#else
  for (int h = registers - 2; h >= 0; h -= 2) {
    r[h + 1] = _mm_shuffle_pd(r[h], r[h + 1], 1);
    r[h] = _mm_shuffle_pd(_mm_setzero_pd(), r[h], 0);
  }
#endif
  for (int i = 0; i < registers; ++i) a.m[i] = reinterpret_cast<NativeMask>(r[i]);
  return a;
}
#endif
/// Lanes 0 .. m-1 of the first half and 0 .. n-1 of the second.
SUTURE_INLINE Mask8 first_lanes_halves(int m, int n) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return from_bits(((1u << m) - 1u) | (((1u << n) - 1u) << 4));
#else
  const long long *p = ladder + 16 - m, *q = ladder + 16 - n;
  Mask8 r;
  for (int k = 0; k < lanes; ++k) r.m[k / width][k % width] = k < 4 ? p[k] : q[k - 4];
  return r;
#endif
}

/// f where the sign bit of s is clear, -f where it is set.
SUTURE_INLINE Double8 with_sign_of(Double8 f, Double8 s) {
  typedef long long Bits __attribute__((vector_size(width * 8)));
  for (int i = 0; i < registers; ++i)
    f.r[i] = reinterpret_cast<Native>(reinterpret_cast<Bits>(f.r[i]) ^
                                      (reinterpret_cast<Bits>(s.r[i]) & (Bits{} + static_cast<long long>(1ull << 63))));
  return f;
}

/// Number of set bits, of eight.
SUTURE_INLINE int set_bits(unsigned mask) {
#if defined(__POPCNT__)
  return __builtin_popcount(mask);
#else
  mask = (mask & 0x55u) + (mask >> 1 & 0x55u);
  mask = (mask & 0x33u) + (mask >> 2 & 0x33u);
  return static_cast<int>((mask & 0xfu) + (mask >> 4));
#endif
}

#if defined(__AVX2__) && !defined(__AVX512F__)
/// Row m: which 32-bit lanes come first when the doubles whose bits are set in m move to the front.
alignas(32) constexpr int packing_lanes[16][8] = {
    {0, 0, 0, 0, 0, 0, 0, 0}, {0, 1, 0, 0, 0, 0, 0, 0}, {2, 3, 0, 0, 0, 0, 0, 0}, {0, 1, 2, 3, 0, 0, 0, 0},
    {4, 5, 0, 0, 0, 0, 0, 0}, {0, 1, 4, 5, 0, 0, 0, 0}, {2, 3, 4, 5, 0, 0, 0, 0}, {0, 1, 2, 3, 4, 5, 0, 0},
    {6, 7, 0, 0, 0, 0, 0, 0}, {0, 1, 6, 7, 0, 0, 0, 0}, {2, 3, 6, 7, 0, 0, 0, 0}, {0, 1, 2, 3, 6, 7, 0, 0},
    {4, 5, 6, 7, 0, 0, 0, 0}, {0, 1, 4, 5, 6, 7, 0, 0}, {2, 3, 4, 5, 6, 7, 0, 0}, {0, 1, 2, 3, 4, 5, 6, 7}};
#endif
/// The lanes whose bits are set in mask, one behind the other, at p. Writes eight doubles or fewer; what is behind the
/// packed ones is undefined.
SUTURE_INLINE void store_packed(double* p, unsigned mask, Double8 a) {
#if defined(__AVX512F__)
  _mm512_storeu_pd(p, _mm512_maskz_compress_pd(static_cast<__mmask8>(mask), a.r[0]));
#elif defined(__AVX2__)
  for (int i = 0; i < registers; ++i) {
    const unsigned own = mask >> (4 * i) & 0xfu;
    const __m256i lane = _mm256_load_si256(reinterpret_cast<const __m256i*>(packing_lanes[own]));
    _mm256_storeu_pd(p, _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(a.r[i]), lane)));
    p += set_bits(own);
  }
#else
  for (int k = 0; k < lanes; ++k) {
    *p = a[k];
    p += mask >> k & 1u;
  }
#endif
}

}  // namespace
