// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The slab kernels for processors with AVX2. Plain arrays only: see src/CMakeLists.txt.
#if defined(__x86_64__)
#include <immintrin.h>

#include "convex/slab_kernels.inl.h"

namespace fcl_prob::detail {

namespace {

struct Vector4 {
  __m256d value;

  explicit Vector4(__m256d v) : value(v) {}
  explicit Vector4(double v) : value(_mm256_set1_pd(v)) {}

  static Vector4 load(const double* from) { return Vector4(_mm256_loadu_pd(from)); }
  void store(double* to) const { _mm256_storeu_pd(to, value); }
  double largest() const {
    const __m128d pair = _mm_max_pd(_mm256_castpd256_pd128(value), _mm256_extractf128_pd(value, 1));
    return _mm_cvtsd_f64(_mm_max_sd(pair, _mm_unpackhi_pd(pair, pair)));
  }
};

Vector4 operator+(const Vector4& a, const Vector4& b) {
  return Vector4(_mm256_add_pd(a.value, b.value));
}
Vector4 operator-(const Vector4& a, const Vector4& b) {
  return Vector4(_mm256_sub_pd(a.value, b.value));
}
Vector4 operator*(const Vector4& a, const Vector4& b) {
  return Vector4(_mm256_mul_pd(a.value, b.value));
}
Vector4 operator/(const Vector4& a, const Vector4& b) {
  return Vector4(_mm256_div_pd(a.value, b.value));
}
Vector4 max(const Vector4& a, const Vector4& b) { return Vector4(_mm256_max_pd(a.value, b.value)); }
Vector4 min(const Vector4& a, const Vector4& b) { return Vector4(_mm256_min_pd(a.value, b.value)); }
Vector4 abs(const Vector4& a) { return Vector4(_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.value)); }
Vector4 sqrt(const Vector4& a) { return Vector4(_mm256_sqrt_pd(a.value)); }
// a where the sign bit is clear, else b.
Vector4 select(const Vector4& sign, const Vector4& a, const Vector4& b) {
  return Vector4(_mm256_blendv_pd(a.value, b.value, sign.value));
}
int greater(const Vector4& a, const Vector4& b) {
  return _mm256_movemask_pd(_mm256_cmp_pd(a.value, b.value, _CMP_GT_OQ));
}

int notLess(const Vector4& a, const Vector4& b) {
  return _mm256_movemask_pd(_mm256_cmp_pd(a.value, b.value, _CMP_GE_OQ));
}

}  // namespace

SlabKernels avx2SlabKernels() { return SlabKernelsOver<Vector4>::table(); }

}  // namespace fcl_prob::detail
#endif
