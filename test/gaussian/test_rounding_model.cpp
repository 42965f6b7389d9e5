// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What docs/rounding.md assumes of the machine, the compiler and the C library.
#include <boost/math/special_functions/expm1.hpp>
#include <cfenv>
#include <cfloat>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "catch.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/narrow_interval.h"
#include "high_precision.h"
#include "random_inputs.h"

namespace fcl_prob {
namespace {

using detail::kEpsilon;
using fcl_prob_test::HighPrecision;
using fcl_prob_test::relativeError;
using fcl_prob_test::uniform;

// Not known when compiling, so that nothing is folded.
double hidden(double value) {
  volatile double copy = value;
  return copy;
}

// The largest relative error of `computed` in units of 2^-52.
template <class Computed, class Truth>
double worstUlp(double from, double to, const Computed& computed, const Truth& truth) {
  std::mt19937 random(11);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = uniform(random, from, to);
    const HighPrecision expected = truth(HighPrecision(x));
    if (expected == 0) continue;
    worst = std::max(worst, relativeError(computed(x), expected) / kEpsilon);
  }
  return worst;
}

}  // namespace

TEST_CASE("arithmetic is IEEE double, to nearest, with subnormal numbers and without contraction") {
  CHECK(std::numeric_limits<double>::is_iec559);
  CHECK(FLT_EVAL_METHOD == 0);
  CHECK(std::fegetround() == FE_TONEAREST);
  CHECK(hidden(DBL_MIN) / 4 > 0);
  // (1 + e)(1 - e) - 1 is 0 if the product is rounded, -e² if it is fused with the sum.
  const double e = hidden(0x1p-30);
  CHECK((1 + e) * (1 - e) - hidden(1.0) == 0.0);
}

TEST_CASE("the C library's functions are as accurate as the bounds assume") {
  CHECK(worstUlp(
            -6, 26.5, [](double x) { return std::erfc(x); },
            [](const HighPrecision& x) { return boost::math::erfc(x); }) < 6);
  CHECK(worstUlp(
            -3, 3, [](double x) { return std::erf(x); },
            [](const HighPrecision& x) { return boost::math::erf(x); }) < 2);
  CHECK(worstUlp(
            -3.2, 3.2, [](double x) { return std::sin(x); },
            [](const HighPrecision& x) { return HighPrecision(sin(x)); }) < 1);
  CHECK(worstUlp(
            -3.2, 3.2, [](double x) { return std::cos(x); },
            [](const HighPrecision& x) { return HighPrecision(cos(x)); }) < 1);
  CHECK(worstUlp(
            -700, 1, [](double x) { return std::exp(x); },
            [](const HighPrecision& x) { return HighPrecision(exp(x)); }) < 1);
  CHECK(worstUlp(
            -40, 0, [](double x) { return std::expm1(x); },
            [](const HighPrecision& x) { return boost::math::expm1(x); }) < 2);
}

TEST_CASE("the density keeps a few ulp as far out as it is not 0") {
  CHECK(worstUlp(
            0, 37.5, [](double h) { return detail::normalDensity(h); },
            [](const HighPrecision& h) {
              const HighPrecision pi = boost::math::constants::pi<HighPrecision>();
              return HighPrecision(exp(-h * h / 2) / sqrt(2 * pi));
            }) < 4);
}

}  // namespace fcl_prob
