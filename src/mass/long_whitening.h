// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The map to the whitened frame in more than double precision.
#pragma once

#include "fcl_prob/gaussian_displacement.h"
#include "mass/rounded_parts.h"

namespace fcl_prob::detail {

/// Q⁻¹ of the axes Q of a displacement, which are a rotation to rounding: (2 - QᵀQ) Qᵀ but for the
/// square of that.
inline LongMatrix3 longInverseAxes(const GaussianDisplacement& displacement) {
  const LongMatrix3 axes = displacement.axes().cast<long double>();
  return (2.0L * LongMatrix3::Identity() - axes.transpose() * axes) * axes.transpose();
}

/// D⁻¹ Q⁻¹ of a displacement Q D ξ of rank 3.
inline LongMatrix3 longWhitening(const GaussianDisplacement& displacement) {
  const LongVector3 deviations = displacement.standardDeviations().cast<long double>();
  return deviations.cwiseInverse().asDiagonal() * longInverseAxes(displacement);
}

}  // namespace fcl_prob::detail
