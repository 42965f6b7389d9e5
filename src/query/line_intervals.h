// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of unions of intervals under a normal distribution of one variable.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fcl_prob/bounds.h"
#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob::detail {

/// [lo, hi], either end may be infinite.
struct LineInterval {
  double lo;
  double hi;
};

/// The part of a displacement along a direction: a normal variable, whose deviation may be 0.
class DisplacementAlong {
 public:
  DisplacementAlong(const GaussianDisplacement& displacement, const Eigen::Vector3d& direction);

  /// Certified mass of a union of intervals whose finite ends are known to within `error`.
  Bounds mass(std::vector<LineInterval> intervals, double error) const;

  /// Derivative of that mass with respect to the mean of the variable; [-inf, inf] if the variable
  /// does not move.
  Bounds slope(std::vector<LineInterval> intervals, double error) const;

 private:
  struct Union {
    std::vector<LineInterval> intervals;
    std::vector<double> joints;  ///< where two intervals touch to within rounding
  };
  static Union unite(std::vector<LineInterval> intervals, double error);
  Bounds standardised(double end, double error) const;
  double densityBound(double at, double error) const;

  double mean_;
  double deviation_;
  double mean_error_;
  double deviation_error_;
};

}  // namespace fcl_prob::detail
