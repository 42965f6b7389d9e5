// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/rule_kernel.h"

#include <cstdint>
#include <cstring>

#include "base/with_avx2.h"

namespace fcl_prob::detail {
namespace {

constexpr int kRuleLanes = 4;
typedef double RuleLanes __attribute__((vector_size(32)));
typedef std::uint64_t RuleBits __attribute__((vector_size(32)));

void load(const double* from, RuleLanes& lanes) { std::memcpy(&lanes, from, sizeof lanes); }

/// Replaces s by exp(-s) for 0 <= s <= kMostRuleExponent, quicker than to the last digit.
void fastExp(RuleLanes& s) {
  constexpr double kMagic = 0x1.8p52;  // added, it leaves the integer in the lowest bits
  constexpr double kLog2e = 1.44269504088896340736;
  constexpr double kLn2High = 0x1.62e42fefa38p-1;
  constexpr double kLn2Low = 0x1.ef35793c7673p-45;
  const RuleLanes shifted = kMagic - s * kLog2e;
  const RuleLanes power = shifted - kMagic;
  const RuleLanes r = -s - power * kLn2High - power * kLn2Low;
  const RuleLanes series =
      1.0 +
      r * (1.0 + r * (1.0 / 2 +
                      r * (1.0 / 6 +
                           r * (1.0 / 24 + r * (1.0 / 120 + r * (1.0 / 720 + r * (1.0 / 5040)))))));
  RuleBits bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  bits = (bits + 1023) << 52;
  RuleLanes scale;
  std::memcpy(&scale, &bits, sizeof scale);
  s = scale * series;
}

}  // namespace

FCL_PROB_WITH_AVX2
double weightedDensity(const double* shares, const double* weights, const double* corners,
                       int count) {
  RuleLanes sum{};
  const RuleLanes most = RuleLanes{} + kMostRuleExponent;
  for (int first = 0; first < count; first += kRuleLanes) {
    RuleLanes s0, s1, s2, s3, weight;
    load(shares + first, s0);
    load(shares + count + first, s1);
    load(shares + 2 * count + first, s2);
    load(shares + 3 * count + first, s3);
    load(weights + first, weight);
    const RuleLanes x = s0 * corners[0] + s1 * corners[3] + s2 * corners[6] + s3 * corners[9];
    const RuleLanes y = s0 * corners[1] + s1 * corners[4] + s2 * corners[7] + s3 * corners[10];
    const RuleLanes z = s0 * corners[2] + s1 * corners[5] + s2 * corners[8] + s3 * corners[11];
    RuleLanes term = 0.5 * (x * x + y * y + z * z);
    term = term < most ? term : most;
    fastExp(term);
    sum += weight * term;
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

}  // namespace fcl_prob::detail
