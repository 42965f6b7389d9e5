// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/gauss_rule.h"

#include <boost/math/special_functions/legendre.hpp>
#include <vector>

namespace fcl_prob::detail {

namespace {

GaussRule makeRule(int size) {
  // Boost gives the zeros that are not negative.
  const std::vector<double> zeros = boost::math::legendre_p_zeros<double>(size);
  GaussRule rule;
  int count = 0;
  for (const double x : zeros) {
    const double slope = boost::math::legendre_p_prime(size, x);
    const double weight = 2.0 / ((1.0 - x * x) * slope * slope);
    rule.node[count] = x;
    rule.weight[count++] = weight;
    if (x != 0.0) {
      rule.node[count] = -x;
      rule.weight[count++] = weight;
    }
  }
  return rule;
}

}  // namespace

const GaussRule& GaussRule::ofSize(int size) {
  static const std::array<GaussRule, kMost + 1> rules = [] {
    std::array<GaussRule, kMost + 1> all;
    for (int n = kFewest; n <= kMost; ++n) all[n] = makeRule(n);
    return all;
  }();
  return rules[size];
}

}  // namespace fcl_prob::detail
