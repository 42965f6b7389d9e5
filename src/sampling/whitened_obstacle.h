// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where in the whitened frame the collisions are: what a sampler of rare events starts from.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <optional>

#include "base/interruption.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/whitening.h"
#include "sampling/obstacle_cover.h"

namespace fcl_prob::detail {

struct WhitenedObstacle {
  /// Its first axis points to the nearest displacement that collides.
  Whitening whitening;

  /// A displacement (whitened) about as near as any that collides; nothing if the shapes meet at
  /// the mean.
  std::optional<Eigen::Vector3d> nearest;

  /// Boxes, or a shell if that has less mass; empty if nothing can collide.
  ObstacleCover cover;
};

/// The distance between two whitened shapes is that of the obstacle from the mean displacement, so
/// FCL's mesh distance finds it; curved shapes stand in as polyhedra around them. Once interrupted
/// it looks for no nearest point any more, and leaves the cover as it is. \throws InvalidRequest if
/// the whitened shapes are not finite
WhitenedObstacle whitenedObstacle(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                                  const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                                  const GaussianDisplacement& displacement, ContactMeaning contact,
                                  bool collides_at_mean, const Interruption& interruption);

}  // namespace fcl_prob::detail
