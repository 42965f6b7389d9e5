// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The dimension and the directions of a set of points.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fcl_prob::detail {

/// Orthonormal directions along which a set of points extends, widest first. In the coordinates
/// `direction·(p - origin) / width` the set fills about a unit cube however thin it is, so that
/// tolerances relative to the widest extent do not swallow the thin one. The convex hull does not
/// depend on the choice of affine coordinates.
struct SpanningFrame {
  Eigen::Vector3d origin;
  Eigen::Matrix3d directions;  ///< columns, right-handed
  Eigen::Vector3d widths;      ///< exactly 0 beyond `dimension`
  int dimension;               ///< 0 a point, 1 a segment, 2 flat, 3 a body

  Eigen::Vector3d coordinates(const Eigen::Vector3d& point) const;
};

/// An extent within rounding of zero counts as zero. `points` is not empty and finite.
SpanningFrame spanningFrame(const std::vector<Eigen::Vector3d>& points);

}  // namespace fcl_prob::detail
