// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Upper bounds of a convex pair for a caller who may not have the time.
#pragma once

#include "base/interruption.h"
#include "convex/c_obstacle.h"
#include "fcl_prob/convex_pcd.h"

namespace fcl_prob::detail {

/// convexPcd() until the interruption is due; the bounds are then those by support values.
ConvexPcdBounds convexPcd(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                          const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                          const Interruption& interruption);

/// Certainly not below P that two bodies meet: the mass of one half-space around their C-obstacle,
/// in microseconds whatever their faces. 1 where GJK proposes none, and for ranks below 3.
double halfSpaceUpper(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement);
double halfSpaceUpper(const CObstacle& obstacle);

}  // namespace fcl_prob::detail
