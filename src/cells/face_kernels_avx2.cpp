// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The kernels of faces for processors with AVX2. Plain arrays only: see src/CMakeLists.txt.
#if defined(__x86_64__)
#include <immintrin.h>

#include "cells/face_kernels.inl.h"

namespace fcl_prob::detail {
namespace {

struct FourByAvx2 {
  static int above(const double* values, const double* limits, double by) {
    const __m256d most = _mm256_add_pd(_mm256_loadu_pd(limits), _mm256_set1_pd(by));
    return _mm256_movemask_pd(_mm256_cmp_pd(_mm256_loadu_pd(values), most, _CMP_NLE_UQ));
  }
};

}  // namespace

FaceKernels avx2FaceKernels() { return FaceKernelsOver<FourByAvx2>::table(); }

}  // namespace fcl_prob::detail
#endif
