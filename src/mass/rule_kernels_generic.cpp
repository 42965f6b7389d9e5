// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The kernel of cubatures for any processor, and the choice.
#include "mass/rule_kernels.inl.h"

namespace fcl_prob::detail {
namespace {

RuleKernel chosenRuleKernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return ruleKernelAvx2();
#endif
  return weightedDensity;
}

}  // namespace

RuleKernel ruleKernel() {
  static const RuleKernel kernel = chosenRuleKernel();
  return kernel;
}

}  // namespace fcl_prob::detail
