// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What bounds on rounding are made of, and units that rounding does not know of.
#pragma once

#include <cmath>
#include <limits>

namespace fcl_prob::detail {

/// 2^-52: twice the largest relative error of one rounding.
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// More than what the rounding of numbers below the least normal one adds up to in any mass, moment
/// or sum of them.
inline constexpr double kUnderflow = 1e-312;

/// The largest power of two that a number > 0 is not below; 1 for 0. Dividing by it is exact, so
/// that nothing computed in that unit depends on the scale of what it is computed from.
inline double powerOfTwoAt(double number) {
  return number > 0.0 ? std::ldexp(1.0, std::ilogb(number)) : 1.0;
}

}  // namespace fcl_prob::detail
