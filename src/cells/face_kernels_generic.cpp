// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The kernels of faces for any processor, and the choice.
#include "cells/face_kernels.inl.h"

namespace fcl_prob::detail {
namespace {

struct FourByOne {
  static int above(const double* values, const double* limits, double by) {
    int mask = 0;
    for (int k = 0; k < kFaceLanes; ++k) mask |= (values[k] <= limits[k] + by ? 0 : 1) << k;
    return mask;
  }
};

FaceKernels chosenFaceKernels() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return avx2FaceKernels();
#endif
  return FaceKernelsOver<FourByOne>::table();
}

}  // namespace

const FaceKernels& faceKernels() {
  static const FaceKernels kernels = chosenFaceKernels();
  return kernels;
}

}  // namespace fcl_prob::detail
