// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The mass of a pair with its gradient, which follows from the first moment of the body.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "base/constants.h"
#include "fcl_prob/bounds.h"
#include "fcl_prob/polytope_mass.h"

namespace fcl_prob::detail {

struct PairMass {
  Bounds mass{0.0, 1.0};
  std::optional<VectorBounds> gradient;  ///< of the mass by the mean, world axes, per metre
};

/// No mass that a double can tell from nothing has a moment of more than this times itself.
inline constexpr double kOutermostMoment = 39.0;

/// A mean that moves by d moves the whitened body by -W d, and the mass changes by moment·W d.
inline VectorBounds gradientOf(const VectorBounds& moment, const Eigen::Matrix3d& whitening) {
  const Eigen::Vector3d middle = moment.middle();
  const Eigen::Vector3d half =
      0.5 * (moment.upper - moment.lower) + 4.0 * kEpsilon * middle.cwiseAbs();
  const Eigen::Vector3d gradient = whitening.transpose() * middle;
  const Eigen::Vector3d error = whitening.transpose().cwiseAbs() * (1.001 * half);
  return {gradient - error, gradient + error};
}

}  // namespace fcl_prob::detail
