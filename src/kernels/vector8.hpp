// Eight doubles as one value: one AVX-512 register, two of AVX2, four of SSE2. The same source is compiled once per
// instruction set (see kernels.hpp), so nothing here may have external linkage. The order of every sum is the same for
// all.
#pragma once

#include <immintrin.h>

#include <cmath>
#include <initializer_list>

#define SUTURE_INLINE __attribute__((always_inline)) inline

namespace {

#if defined(__AVX512F__) && defined(__AVX512DQ__)
constexpr int width = 8;
#elif defined(__AVX2__)
constexpr int width = 4;
#else
constexpr int width = 2;
#endif
constexpr int lanes = 8, registers = lanes / width;

typedef double Native __attribute__((vector_size(width * 8)));
typedef double UnalignedNative __attribute__((vector_size(width * 8), aligned(8), may_alias));

struct Double8 {
  Native r[registers];
  SUTURE_INLINE double operator[](int k) const { return r[k / width][k % width]; }
};

SUTURE_INLINE Double8 load(const double* p) {
  Double8 a;
  for (int i = 0; i < registers; ++i) a.r[i] = *reinterpret_cast<const UnalignedNative*>(p + i * width);
  return a;
}
SUTURE_INLINE void store(double* p, Double8 a) {
  for (int i = 0; i < registers; ++i) *reinterpret_cast<UnalignedNative*>(p + i * width) = a.r[i];
}
SUTURE_INLINE Double8 broadcast(double a) {
  Double8 b;
  for (int i = 0; i < registers; ++i) b.r[i] = a - Native{};
  return b;
}

#define SUTURE_OPERATOR(op)                                                            \
  SUTURE_INLINE Double8 operator op(Double8 a, Double8 b) {                            \
    for (int i = 0; i < registers; ++i) a.r[i] = a.r[i] op b.r[i];                     \
    return a;                                                                          \
  }                                                                                    \
  SUTURE_INLINE Double8 operator op(Double8 a, double b) { return a op broadcast(b); } \
  SUTURE_INLINE Double8 operator op(double a, Double8 b) { return broadcast(a) op b; } \
  SUTURE_INLINE Double8& operator op##=(Double8& a, Double8 b) { return a = a op b; }
SUTURE_OPERATOR(+)
SUTURE_OPERATOR(-)
SUTURE_OPERATOR(*)
SUTURE_OPERATOR(/)
#undef SUTURE_OPERATOR
SUTURE_INLINE Double8 operator-(Double8 a) {
  for (int i = 0; i < registers; ++i) a.r[i] = -a.r[i];
  return a;
}

/// The intrinsic of this width.
#if defined(__AVX512F__)
#define SUTURE_NATIVE(name) _mm512_##name##_pd
#elif defined(__AVX2__)
#define SUTURE_NATIVE(name) _mm256_##name##_pd
#else
#define SUTURE_NATIVE(name) _mm_##name##_pd
#endif

SUTURE_INLINE Double8 square_root(Double8 a) {
  for (int i = 0; i < registers; ++i) a.r[i] = SUTURE_NATIVE(sqrt)(a.r[i]);
  return a;
}

/// 1/sqrt(a) to 2 ulp, not finite at zero. Division and square root are the slowest instructions of the rate, so both
/// go by the series of (1 - h)^(-1/2): AVX-512 starts from 14 bits; AVX2 from half the exponent (an integer
/// subtraction, 3.4 % off), improved by a cubic fitted to it (relative error 7.5e-7).
SUTURE_INLINE Double8 inverse_square_root(Double8 a) {
#if defined(__AVX512F__)
  const Double8 r{{_mm512_rsqrt14_pd(a.r[0])}};
  const Double8 h = 1.0 - (a * r) * r;
  return r + (r * h) * (0.5 + h * (0.375 + h * broadcast(0.3125)));
#elif defined(__AVX2__)
  Double8 r;
  for (int i = 0; i < registers; ++i)
    r.r[i] = _mm256_castsi256_pd(
        _mm256_sub_epi64(_mm256_set1_epi64x(0x5fe6eb50c7b537a9), _mm256_srli_epi64(_mm256_castpd_si256(a.r[i]), 1)));
  const Double8 h = 1.0 - (a * r) * r;
  r *= 0.9999992536246689 + h * (0.5000004239892812 + h * (0.3762790098503428 + h * broadcast(0.3130539030379249)));
  const Double8 g = 1.0 - (a * r) * r;
  r += (r * g) * (0.5 + g * broadcast(0.375));
  for (int i = 0; i < registers; ++i)
    r.r[i] = _mm256_blendv_pd(_mm256_set1_pd(INFINITY), r.r[i], _mm256_cmp_pd(a.r[i], _mm256_setzero_pd(), _CMP_GT_OQ));
  return r;
#else
  return 1.0 / square_root(a);
#endif
}

/// 1/a to 2 ulp.
SUTURE_INLINE Double8 inverse(Double8 a) {
#if defined(__AVX512F__)
  const Double8 r{{_mm512_rcp14_pd(a.r[0])}};
  const Double8 s = r + r * (1.0 - a * r);
  return s + s * (1.0 - a * s);
#else
  return 1.0 / a;
#endif
}

/// One truth per lane: a mask register of AVX-512, registers of all-ones and all-zeros otherwise.
#if defined(__AVX512F__) && defined(__AVX512DQ__)
struct Mask8 {
  __mmask8 m;
};
SUTURE_INLINE Mask8 less(Double8 a, Double8 b) { return {_mm512_cmp_pd_mask(a.r[0], b.r[0], _CMP_LT_OQ)}; }
SUTURE_INLINE Double8 select(Mask8 m, Double8 a, Double8 b) { return {{_mm512_mask_blend_pd(m.m, b.r[0], a.r[0])}}; }
SUTURE_INLINE unsigned bits(Mask8 a) { return a.m; }
SUTURE_INLINE Mask8 from_bits(unsigned bits) { return {static_cast<__mmask8>(bits)}; }
SUTURE_INLINE Mask8 operator&(Mask8 a, Mask8 b) { return from_bits(a.m & b.m); }
SUTURE_INLINE Mask8 operator|(Mask8 a, Mask8 b) { return from_bits(a.m | b.m); }
SUTURE_INLINE Mask8 operator~(Mask8 a) { return from_bits(~a.m); }
#else
typedef long long NativeMask __attribute__((vector_size(width * 8)));
struct Mask8 {
  NativeMask m[registers];
};
SUTURE_INLINE Mask8 less(Double8 a, Double8 b) {
  Mask8 r;
  for (int i = 0; i < registers; ++i) r.m[i] = a.r[i] < b.r[i];
  return r;
}
SUTURE_INLINE Double8 select(Mask8 m, Double8 a, Double8 b) {
  for (int i = 0; i < registers; ++i)
    a.r[i] = reinterpret_cast<Native>((m.m[i] & reinterpret_cast<NativeMask>(a.r[i])) |
                                      (~m.m[i] & reinterpret_cast<NativeMask>(b.r[i])));
  return a;
}
SUTURE_INLINE unsigned bits(Mask8 a) {
  unsigned r = 0;
  for (int i = 0; i < registers; ++i) {
#if defined(__AVX2__)
    r |= static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(a.m[i]))) << (i * width);
#else
    r |= static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(a.m[i]))) << (i * width);
#endif
  }
  return r;
}
alignas(64) constexpr long long ladder[24] = {0,  0,  0,  0,  0, 0, 0, 0, -1, -1, -1, -1,
                                              -1, -1, -1, -1, 0, 0, 0, 0, 0,  0,  0,  0};
#define SUTURE_OPERATOR(op)                                        \
  SUTURE_INLINE Mask8 operator op(Mask8 a, Mask8 b) {              \
    for (int i = 0; i < registers; ++i) a.m[i] = a.m[i] op b.m[i]; \
    return a;                                                      \
  }
SUTURE_OPERATOR(&)
SUTURE_OPERATOR(|)
#undef SUTURE_OPERATOR
SUTURE_INLINE Mask8 operator~(Mask8 a) {
  for (int i = 0; i < registers; ++i) a.m[i] = ~a.m[i];
  return a;
}
#endif
SUTURE_INLINE Mask8 less(Double8 a, double b) { return less(a, broadcast(b)); }
SUTURE_INLINE Mask8 less(double a, Double8 b) { return less(broadcast(a), b); }
/// a where m, +0 elsewhere.
SUTURE_INLINE Double8 only(Mask8 m, Double8 a) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return {{_mm512_maskz_mov_pd(m.m, a.r[0])}};
#else
  for (int i = 0; i < registers; ++i) a.r[i] = reinterpret_cast<Native>(m.m[i] & reinterpret_cast<NativeMask>(a.r[i]));
  return a;
#endif
}
SUTURE_INLINE bool any(Mask8 a) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return a.m != 0;
#else
  for (int i = 1; i < registers; ++i) a.m[0] |= a.m[i];
#if defined(__AVX2__)
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(a.m[0])) != 0;
#else
  return _mm_movemask_pd(reinterpret_cast<__m128d>(a.m[0])) != 0;
#endif
#endif
}
/// Lanes 0 .. n-1; all for n > 8. n >= 0.
SUTURE_INLINE Mask8 first_lanes(int n) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return from_bits(_bzhi_u32(0xffu, static_cast<unsigned>(n < lanes ? n : lanes)));
#else
  const long long* p = ladder + 16 - (n < lanes ? n : lanes);
  Mask8 r;
  for (int k = 0; k < lanes; ++k) r.m[k / width][k % width] = p[k];
  return r;
#endif
}

/// a where a > b (minimum: a < b), b elsewhere: b for what is not a number.
SUTURE_INLINE Double8 maximum(Double8 a, Double8 b) {
  for (int i = 0; i < registers; ++i) a.r[i] = SUTURE_NATIVE(max)(a.r[i], b.r[i]);
  return a;
}
SUTURE_INLINE Double8 minimum(Double8 a, Double8 b) {
  for (int i = 0; i < registers; ++i) a.r[i] = SUTURE_NATIVE(min)(a.r[i], b.r[i]);
  return a;
}

#undef SUTURE_NATIVE

/// Sum of all lanes.
SUTURE_INLINE double sum(Double8 a) {
  const double even = (a[0] + a[4]) + (a[2] + a[6]), odd = (a[1] + a[5]) + (a[3] + a[7]);
  return even + odd;
}

/// 4 atan(w) for |w| <= tan(pi/8): odd polynomial of degree 21, relative error 2.3e-16 (own Chebyshev fit). Even and odd
/// powers of w^2 apart, so that the chain of dependent operations is half as long.
SUTURE_INLINE Double8 four_arctangents(Double8 w) {
  const Double8 u = w * w, v = u * u;
  Double8 even = broadcast(0.021128607504723874), odd = broadcast(-0.04347499662667871);
  even = even * v + 0.05688157926019374;
  odd = odd * v - 0.06640197366695386;
  even = even * v + 0.0768994928650073;
  odd = odd * v - 0.09090772775888224;
  even = even * v + 0.11111106167586494;
  odd = odd * v - 0.14285714180659678;
  even = even * v + 0.1999999999885117;
  odd = odd * v - 0.3333333333332842;
  even = even * v + 1.0;
  return (4.0 * w) * (even + odd * u);
}

}  // namespace
