// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The part of a Halfspace or Plane that a displacement can reach.
#pragma once

#include <fcl/common/types.h>
#include <fcl/geometry/collision_geometry.h>

#include <memory>

#include "fcl_prob/gaussian_displacement.h"
#include "scene/partition_object.h"

namespace fcl_prob::detail {

/// A bounded geometry with its pose in the world frame.
struct BoundedPart {
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  fcl::Transform3d pose;
};

/// A ball (world frame, metres) that `object` does not leave when displaced by up to `deviations`
/// standard deviations.
struct ReachedBall {
  Eigen::Vector3d centre;
  double radius;
};
ReachedBall reachedBall(const PartitionObject& object, const GaussianDisplacement& displacement,
                        double deviations);

/// A box (of a Halfspace) or a triangle (of a Plane) that is contained in the unbounded shape and
/// contains all of it in `ball` (world frame): anything that stays there
/// touches the one if and only if it touches the other.
BoundedPart boundedPart(const fcl::CollisionGeometryd& unbounded, const fcl::Transform3d& pose,
                        const ReachedBall& ball);

}  // namespace fcl_prob::detail
