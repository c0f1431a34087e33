// Between memory and lanes, and between lanes: pairs, windows of slots, live lanes packed one behind the other. Compiled
// once per instruction set, like vector8.hpp.
#pragma once

#include "kernels/vector8.hpp"

namespace {

struct Pairs8 {
  Double8 x, y;
};
/// Eight (x, y) from p on.
SUTURE_INLINE Pairs8 load_pairs(const double* p) {
  Pairs8 c;
#if defined(__AVX512F__)
  const Double8 a = load(p), b = load(p + lanes);
  const __m512i even = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14), odd = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
  c.x.r[0] = _mm512_permutex2var_pd(a.r[0], even, b.r[0]), c.y.r[0] = _mm512_permutex2var_pd(a.r[0], odd, b.r[0]);
#else
  for (int i = 0; i < registers; ++i, p += 2 * width) {
    const Native a = *reinterpret_cast<const UnalignedNative*>(p), b = *reinterpret_cast<const UnalignedNative*>(p + width);
#if defined(__AVX2__)
    c.x.r[i] = _mm256_permute4x64_pd(_mm256_unpacklo_pd(a, b), 0xd8);
    c.y.r[i] = _mm256_permute4x64_pd(_mm256_unpackhi_pd(a, b), 0xd8);
#else
    c.x.r[i] = _mm_unpacklo_pd(a, b);
    c.y.r[i] = _mm_unpackhi_pd(a, b);
#endif
  }
#endif
  return c;
}
/// Stores (x, y) of lane k at p + 2 k.
SUTURE_INLINE void store_pairs(double* p, Double8 x, Double8 y) {
#if defined(__AVX512F__)
  const __m512i low = _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11), high = _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15);
  store(p, {{_mm512_permutex2var_pd(x.r[0], low, y.r[0])}});
  store(p + lanes, {{_mm512_permutex2var_pd(x.r[0], high, y.r[0])}});
#else
  for (int i = 0; i < registers; ++i, p += 2 * width) {
#if defined(__AVX2__)
    const Native low = _mm256_unpacklo_pd(x.r[i], y.r[i]), high = _mm256_unpackhi_pd(x.r[i], y.r[i]);
    _mm256_storeu_pd(p, _mm256_permute2f128_pd(low, high, 0x20));
    _mm256_storeu_pd(p + width, _mm256_permute2f128_pd(low, high, 0x31));
#else
    _mm_storeu_pd(p, _mm_unpacklo_pd(x.r[i], y.r[i]));
    _mm_storeu_pd(p + width, _mm_unpackhi_pd(x.r[i], y.r[i]));
#endif
  }
#endif
}
/// a moved up by one lane; its first lane is the last one of `before`.
SUTURE_INLINE Double8 shift_in(Double8 before, Double8 a) {
  Double8 r;
  for (int i = 0; i < registers; ++i) {
    const Native low = i == 0 ? before.r[registers - 1] : a.r[i - 1];
#if defined(__AVX512F__)
    r.r[i] = _mm512_castsi512_pd(_mm512_alignr_epi64(_mm512_castpd_si512(a.r[i]), _mm512_castpd_si512(low), 7));
#elif defined(__AVX2__)
    r.r[i] = _mm256_shuffle_pd(_mm256_permute2f128_pd(low, a.r[i], 0x21), a.r[i], 0x5);
#else
    r.r[i] = _mm_shuffle_pd(low, a.r[i], 1);
#endif
  }
  return r;
}
#if defined(__AVX2__)
/// p[i[0]], p[i[2]], p[i[4]], p[i[6]]. Each is loaded into its lane: blends have more ports than shuffles and gathers.
SUTURE_INLINE __m256d load_four(const double* p, const int* i) {
  const __m256d low = _mm256_blend_pd(_mm256_loadu_pd(p + i[0]), _mm256_loadu_pd(p + i[2] - 1), 2);
  const __m256d high = _mm256_blend_pd(_mm256_loadu_pd(p + i[4] - 2), _mm256_loadu_pd(p + i[6] - 3), 8);
  return _mm256_blend_pd(low, high, 12);
}
#endif
/// Lane k from p + i[2 k]; i is every other number of sixteen. What is up to three before and after each can be read, too.
SUTURE_INLINE Double8 load_each(const double* p, const int* i) {
#if defined(__AVX512F__)
  return {{_mm512_insertf64x4(_mm512_castpd256_pd512(load_four(p, i)), load_four(p, i + 8), 1)}};
#else
  Double8 a;
  for (int k = 0; k < registers; ++k) {
    const int* j = i + 2 * k * width;
#if defined(__AVX2__)
    a.r[k] = load_four(p, j);
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
  const auto halves = [p](int low, int high) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(p + low)), _mm256_loadu_pd(p + high), 1);
  };
  const __m512d r0 = halves(i[0], i[4]), r1 = halves(i[2], i[6]), r2 = halves(i[8], i[12]), r3 = halves(i[10], i[14]);
  const __m512d even0 = _mm512_unpacklo_pd(r0, r1), odd0 = _mm512_unpackhi_pd(r0, r1);
  const __m512d even1 = _mm512_unpacklo_pd(r2, r3), odd1 = _mm512_unpackhi_pd(r2, r3);
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
