// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The kernel of cubatures for processors with AVX2. Plain arrays only: see src/CMakeLists.txt.
#if defined(__x86_64__)
#include "mass/rule_kernels.inl.h"

namespace fcl_prob::detail {

RuleKernel ruleKernelAvx2() { return weightedDensity; }

}  // namespace fcl_prob::detail
#endif
