// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The kernel of masses below planes for processors with AVX2. Plain arrays only: see
// src/CMakeLists.txt.
#if defined(__x86_64__)
#include "mass/cut_kernels.inl.h"

namespace fcl_prob::detail {

CutKernel cutKernelAvx2() { return pieceMass; }

}  // namespace fcl_prob::detail
#endif
