// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The kernel of masses below planes for any processor, and the choice.
#include "mass/cut_kernels.inl.h"

namespace fcl_prob::detail {
namespace {

CutKernel chosenCutKernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return cutKernelAvx2();
#endif
  return pieceMass;
}

}  // namespace

CutKernel cutKernel() {
  static const CutKernel kernel = chosenCutKernel();
  return kernel;
}

}  // namespace fcl_prob::detail
