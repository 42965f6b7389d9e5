// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The density kernel for any processor, and the choice.
#include "gaussian/density_kernels.inl.h"

namespace fcl_prob::detail {
namespace {

DensityKernel chooseKernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return densityKernelAvx2();
#endif
  return densityOfLines;
}

}  // namespace

DensityKernel densityKernel() {
  static const DensityKernel kernel = chooseKernel();
  return kernel;
}

}  // namespace fcl_prob::detail
