// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Units that rounding does not know of.
#pragma once

#include <cmath>

namespace fcl_prob::detail {

/// The largest power of two that a number > 0 is not below; 1 for 0. Dividing by it is exact, so
/// that nothing computed in that unit depends on the scale of what it is computed from.
inline double powerOfTwoAt(double number) {
  return number > 0.0 ? std::ldexp(1.0, std::ilogb(number)) : 1.0;
}

}  // namespace fcl_prob::detail
