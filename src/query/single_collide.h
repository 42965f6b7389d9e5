// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A displacement that is certain.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>

#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// P is 1 if `a`, moved by `displacement` (metres, world frame), collides with `b`, else 0.
/// \throws UnsupportedGeometry, OpenMesh
ProbabilityResult singleCollide(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                                const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                                const Eigen::Vector3d& displacement,
                                const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
