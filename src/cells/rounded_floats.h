// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Arrays of doubles as floats that are certainly below, or above.
#pragma once

#include <Eigen/Core>

namespace fcl_prob::detail {

/// Three times half of what neighbouring floats differ by, as a share.
inline constexpr float kRoundedFloat = 1.8e-7F;

/// No more than the values, which are not +∞.
template <typename Values>
auto floatsBelow(const Values& values) {
  const auto nearest = values.template cast<float>().eval();
  return (nearest - kRoundedFloat * nearest.abs() - 1e-37F).eval();
}

/// No less than the values, which are not -∞.
template <typename Values>
auto floatsAbove(const Values& values) {
  const auto nearest = values.template cast<float>().eval();
  return (nearest + kRoundedFloat * nearest.abs() + 1e-37F).eval();
}

}  // namespace fcl_prob::detail
