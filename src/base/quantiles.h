// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Boost's inverse distribution functions, compiled in one place: each file that uses them would
// take seconds for them.
#pragma once

namespace fcl_prob::detail {

/// The y with erfc(y) = `value`.
double erfcInverse(double value);

/// The same, computed in double: Boost's own takes long double, at three times the cost.
double erfcInverseInDouble(double value);

/// log Γ(x)
double logGamma(double x);

/// Q(a, x), the regularised incomplete gamma function.
double gammaQ(double a, double x);

/// The x with P(a, x) = `value`, P = 1 - Q.
double gammaPInverse(double a, double value);

/// The x with Q(a, x) = `value`.
double gammaQInverse(double a, double value);

/// Where a distribution has `below` of its mass below, or `above` above.
double normalQuantile(double below);
double chiSquaredQuantile(double freedom, double below);
double betaQuantile(double alpha, double beta, double below);
double betaQuantileAbove(double alpha, double beta, double above);

}  // namespace fcl_prob::detail
