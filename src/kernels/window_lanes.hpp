// The lanes of the contact kernel: one window each, and live ones packed one behind the other. Compiled once per instruction
// set, like vector8.hpp.
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
/// The same 64 bits in every lane.
SUTURE_INLINE Double8 bit_pattern(long long n) {
  typedef long long Bits __attribute__((vector_size(width * 8)));
  Double8 a;
  for (int i = 0; i < registers; ++i) a.r[i] = reinterpret_cast<Native>(Bits{} + n);
  return a;
}
/// The sums of the bit patterns as integers.
SUTURE_INLINE Double8 add_bits(Double8 a, Double8 n) {
  typedef long long Bits __attribute__((vector_size(width * 8)));
  for (int i = 0; i < registers; ++i)
    a.r[i] = reinterpret_cast<Native>(reinterpret_cast<Bits>(a.r[i]) + reinterpret_cast<Bits>(n.r[i]));
  return a;
}
/// Lane k from p + i[2 k]; i is every other number of sixteen.
SUTURE_INLINE Double8 load_each(const double* p, const int* i) {
#if defined(__AVX512F__)
  return {{_mm512_i32gather_pd(_mm512_cvtepi64_epi32(_mm512_loadu_si512(i)), p, 8)}};
#else
  Double8 a;
  for (int k = 0; k < registers; ++k) {
    const int* j = i + 2 * k * width;
#if defined(__AVX2__)
    a.r[k] = _mm256_set_pd(p[j[6]], p[j[4]], p[j[2]], p[j[0]]);
#else
    a.r[k] = _mm_set_pd(p[j[2]], p[j[0]]);
#endif
  }
  return a;
#endif
}
/// Lane k of a[m] from p + i[2 k] + m.
SUTURE_INLINE void load_quads(const double* p, const int* i, Double8* a) {
#if defined(__AVX512F__)
  const Double8 r0 = load_halves(p + i[0], p + i[4]), r1 = load_halves(p + i[2], p + i[6]);
  const Double8 r2 = load_halves(p + i[8], p + i[12]), r3 = load_halves(p + i[10], p + i[14]);
  const __m512d even0 = _mm512_unpacklo_pd(r0.r[0], r1.r[0]), odd0 = _mm512_unpackhi_pd(r0.r[0], r1.r[0]);
  const __m512d even1 = _mm512_unpacklo_pd(r2.r[0], r3.r[0]), odd1 = _mm512_unpackhi_pd(r2.r[0], r3.r[0]);
  a[0].r[0] = _mm512_shuffle_f64x2(even0, even1, 0x88), a[1].r[0] = _mm512_shuffle_f64x2(odd0, odd1, 0x88);
  a[2].r[0] = _mm512_shuffle_f64x2(even0, even1, 0xdd), a[3].r[0] = _mm512_shuffle_f64x2(odd0, odd1, 0xdd);
#elif defined(__AVX2__)
  for (int k = 0; k < registers; ++k, i += 2 * width) {
    const __m256d r0 = _mm256_loadu_pd(p + i[0]), r1 = _mm256_loadu_pd(p + i[2]);
    const __m256d r2 = _mm256_loadu_pd(p + i[4]), r3 = _mm256_loadu_pd(p + i[6]);
    const __m256d even0 = _mm256_unpacklo_pd(r0, r1), odd0 = _mm256_unpackhi_pd(r0, r1);
    const __m256d even1 = _mm256_unpacklo_pd(r2, r3), odd1 = _mm256_unpackhi_pd(r2, r3);
    a[0].r[k] = _mm256_permute2f128_pd(even0, even1, 0x20), a[1].r[k] = _mm256_permute2f128_pd(odd0, odd1, 0x20);
    a[2].r[k] = _mm256_permute2f128_pd(even0, even1, 0x31), a[3].r[k] = _mm256_permute2f128_pd(odd0, odd1, 0x31);
  }
#else
  for (int k = 0; k < registers; ++k, i += 2 * width)
    for (int half = 0; half < 4; half += 2) {
      const __m128d r0 = _mm_loadu_pd(p + i[0] + half), r1 = _mm_loadu_pd(p + i[2] + half);
      a[half].r[k] = _mm_unpacklo_pd(r0, r1), a[half + 1].r[k] = _mm_unpackhi_pd(r0, r1);
    }
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
