// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Vectors of more than double precision, where the compiler has it.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace fcl_prob::detail {

using LongVector3 = Eigen::Matrix<long double, 3, 1>;
using LongMatrix3 = Eigen::Matrix<long double, 3, 3>;

/// Twice the largest relative error of one rounding of a long double: 2⁻⁶³ on x86.
inline constexpr double kLongEpsilon =
    static_cast<double>(std::numeric_limits<long double>::epsilon());

}  // namespace fcl_prob::detail
