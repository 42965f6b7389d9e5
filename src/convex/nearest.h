// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Proposals for the direction in which the mean is separated from a C-obstacle.
#pragma once

#include <Eigen/Core>

#include "convex/c_obstacle.h"

namespace fcl_prob::detail {

/// Directions from the mean (the origin of the whitened frame) towards V; unit vectors, or zero if
/// there is none. They are proposals: a bound must take its offset from a support value.
struct Separation {
  /// Towards the nearest point; zero if the mean is inside.
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();

  /// Against the normal of the face whose plane is farthest from the mean (inside: least deep).
  Eigen::Vector3d face = Eigen::Vector3d::Zero();

  /// Radius of the largest ball around the mean inside the faces; 0 outside.
  double depth = 0.0;
};

/// By looking at every face. Faces across a coordinate beyond the first `rank` are left out.
Separation separationOf(const FaceSet& faces, int rank = 3);

/// By FCL's GJK on support points, for curved bodies; zero if it does not succeed.
Eigen::Vector3d gjkDirection(const CObstacle& obstacle);

/// The direction of the longest edge after projection along `axis` (unit), as a unit vector
/// orthogonal to it.
Eigen::Vector3d longestEdgeAcross(const FaceSet& faces, const Eigen::Vector3d& axis);

}  // namespace fcl_prob::detail
