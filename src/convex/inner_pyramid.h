// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A part of a cell that certainly lies within a C-obstacle, as far as a pyramid of five of its
// points shows it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "convex/support_obstacle.h"

namespace fcl_prob::detail {

/// A cell near the boundary of V: the planes n·y = const are about parallel to the boundary, and
/// steepest across `axis`.
struct BoundaryCell {
  Eigen::Vector3d middle;
  Eigen::Vector3d half;
  int rank;                ///< half is 0 from here on
  Eigen::Vector3d normal;  ///< unit, outward
  double lowest;           ///< min of normal·y over the cell
  int axis;
  double padding;  ///< no point of V is farther from its true place
};

/// The largest known s such that { normal·y <= s } ∩ cell is within V: shown by a pyramid of a
/// point of V deep below the cell and four points of its boundary around the cell, which are
/// support points in directions that the curvature of V gives. Nothing if no such pyramid was
/// found.
std::optional<double> innerPlane(const SupportObstacle& obstacle, const BoundaryCell& cell);

}  // namespace fcl_prob::detail
