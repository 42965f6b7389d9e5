// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Sums of upper bounds.
#pragma once

namespace fcl_prob::detail {

/// No less than the sum of two numbers that are not negative, which doubles round by 1.2e-16 of it.
inline double sumAbove(double a, double b) { return (a + b) * (1.0 + 1e-15); }

}  // namespace fcl_prob::detail
