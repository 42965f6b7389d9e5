// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The inner loop of cubatures over tetrahedra, over plain arrays of doubles.
#pragma once

namespace fcl_prob::detail {

/// What fastExp() in rule_kernel.cpp may be off by, relative: its series ends behind the seventh
/// power, and 0.347⁸ / 8! · e^0.347 < 7.4e-9.
inline constexpr double kRuleExpError = 8e-9;

/// Exponents are cut off there, so that exp() needs no special cases: what lies farther out is
/// taken to be as dense as that, and wrong by no more.
inline constexpr double kMostRuleExponent = 700.0;

/// Σ weight_i exp(-|y_i|² / 2) over the points y_i = Σ_k share_k[i] v_k of a tetrahedron.
/// \param shares   those of the corner v_k from shares[k count] on
/// \param corners  v_k at corners[3 k]
/// \param count    a multiple of four: what is not needed has no weight
double weightedDensity(const double* shares, const double* weights, const double* corners,
                       int count);

}  // namespace fcl_prob::detail
