// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Ground truth in 50 decimal digits that shares no code with the library.
#pragma once

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace fcl_prob_test {

using HighPrecision = boost::multiprecision::cpp_bin_float_50;

/// Φ(-h)
inline HighPrecision trueTail(const HighPrecision& h) {
  return boost::math::erfc(h / sqrt(HighPrecision(2))) / 2;
}

/// Mass of [lo, hi]; the ends may be infinite. With 100 digits the difference of two tails
/// keeps 50.
inline HighPrecision trueIntervalMass(const HighPrecision& lo, const HighPrecision& hi) {
  const auto tail = [](const HighPrecision& h) {
    if (isinf(h)) return HighPrecision(h > 0 ? 0 : 1);
    return trueTail(h);
  };
  if (lo + hi < 0) return tail(-hi) - tail(-lo);
  return tail(lo) - tail(hi);
}

/// |value / truth - 1|
inline double relativeError(double value, const HighPrecision& truth) {
  const HighPrecision error = abs(HighPrecision(value) / truth - 1);
  return error.convert_to<double>();
}

}  // namespace fcl_prob_test
