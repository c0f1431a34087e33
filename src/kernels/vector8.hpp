// Eight doubles as one value, through GCC's vector extension: one AVX-512 register, two AVX2, four SSE2. The same
// source is compiled once per instruction set (see kernels.hpp), so nothing here may have external linkage.
#pragma once

#include <cmath>
#include <initializer_list>
#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace {

typedef double Double8 __attribute__((vector_size(64)));
typedef long long Mask8 __attribute__((vector_size(64)));
typedef double UnalignedDouble8 __attribute__((vector_size(64), aligned(8), may_alias));

constexpr int lanes = 8;

inline Double8 load(const double* p) { return *reinterpret_cast<const UnalignedDouble8*>(p); }
inline void store(double* p, Double8 v) { *reinterpret_cast<UnalignedDouble8*>(p) = v; }
inline Double8 broadcast(double a) { return Double8{a, a, a, a, a, a, a, a}; }

inline Double8 square_root(Double8 a) {
#if defined(__AVX512F__)
  return reinterpret_cast<Double8>(_mm512_sqrt_pd(reinterpret_cast<__m512d>(a)));
#else
  Double8 r;
  for (int k = 0; k < lanes; ++k) r[k] = std::sqrt(a[k]);
  return r;
#endif
}

inline Double8 select(Mask8 m, Double8 a, Double8 b) { return m ? a : b; }

/// Lane k receives lane k - 1; lane 0 receives zero.
inline Double8 shift_up(Double8 a) {
  return __builtin_shuffle(Double8{}, a, Mask8{0, 8, 9, 10, 11, 12, 13, 14});
}
inline Mask8 shift_up(Mask8 a) { return __builtin_shuffle(Mask8{}, a, Mask8{0, 8, 9, 10, 11, 12, 13, 14}); }

inline unsigned bits(Mask8 m) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask(reinterpret_cast<__m512i>(m));
#else
  unsigned r = 0;
  for (int k = 0; k < lanes; ++k) r |= (m[k] ? 1u : 0u) << k;
  return r;
#endif
}
inline bool any(Mask8 m) { return bits(m) != 0; }

/// Sum in one fixed order, the same for every instruction set.
inline double sum(Double8 a) {
  a += __builtin_shuffle(a, Mask8{4, 5, 6, 7, 0, 1, 2, 3});
  a += __builtin_shuffle(a, Mask8{2, 3, 0, 1, 6, 7, 4, 5});
  return a[0] + a[1];
}

inline Double8 maximum(Double8 a, Double8 b) { return select(a > b, a, b); }

/// atan(w) for |w| <= tan(pi/8): odd polynomial of degree 21, relative error 2.3e-16 (own Chebyshev fit).
inline Double8 small_arctangent(Double8 w) {
  const Double8 u = w * w;
  Double8 p = broadcast(0.021128607504723874);
  p = p * u - 0.04347499662667871;
  p = p * u + 0.05688157926019374;
  p = p * u - 0.06640197366695386;
  p = p * u + 0.0768994928650073;
  p = p * u - 0.09090772775888224;
  p = p * u + 0.11111106167586494;
  p = p * u - 0.14285714180659678;
  p = p * u + 0.1999999999885117;
  p = p * u - 0.3333333333332842;
  p = p * u + 1.0;
  return w * p;
}

}  // namespace
