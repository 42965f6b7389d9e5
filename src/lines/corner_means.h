// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Means over a column of tails of the normal distribution, from their values at its corners.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "lines/node_spans.h"

namespace fcl_prob::detail {

/// Where lines at the four corners of a column begin or end.
using CornerValues = std::array<double, 4>;

/// Φ(-s) is convex for s >= 0, and a function that is linear along both axes has a mean that
/// follows from its corners and the mean place in the column.
class CornerMeans {
 public:
  /// Nothing for a column that reaches to the end of the space, or is too small to be measured.
  static std::optional<CornerMeans> of(const Column& column);

  const Eigen::Vector2d& corner(int k) const { return corners_[static_cast<std::size_t>(k)]; }

  /// No less than the mean over the column of a function that is nowhere above what is linear
  /// along both axes between such values at the corners.
  double most(const CornerValues& of_corners) const;

  /// No less than the mean of Φ(-s), where s is nowhere less than what is linear along both axes
  /// between the values given.
  double mostTail(const CornerValues& s) const;

  /// No more than the mean of Φ(-s), where s is nowhere more than that.
  double leastTail(const CornerValues& s) const;

 private:
  std::array<Eigen::Vector2d, 4> corners_;
  CornerValues weights_;
  double slack_ = 0.0;  ///< all together, weights are off by no more
};

}  // namespace fcl_prob::detail
