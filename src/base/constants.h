// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What bounds on rounding are made of.
#pragma once

#include <limits>

namespace fcl_prob::detail {

/// 2^-52: twice the largest relative error of one rounding.
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// More than what the rounding of numbers below the least normal one adds up to in any mass, moment
/// or sum of them.
inline constexpr double kUnderflow = 1e-312;

}  // namespace fcl_prob::detail
