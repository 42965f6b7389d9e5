// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The density kernel for processors with AVX2. Plain arrays only: see src/CMakeLists.txt.
#if defined(__x86_64__)
#include "gaussian/density_kernels.inl.h"

namespace fcl_prob::detail {

DensityKernel densityKernelAvx2() { return densityOfLines; }

}  // namespace fcl_prob::detail
#endif
