// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Upper bounds on the collision probability of two convex bodies.
#pragma once

#include <fcl/common/types.h>

#include <Eigen/Core>

#include "fcl_prob/bounds.h"
#include "fcl_prob/convex_body.h"
#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob {

/// Each is at least P on every input (rounding included); those besides `least` may exceed 1.
struct ConvexPcdBounds {
  double least = 1.0;  ///< the least of those below, and 1: the product

  /// Φ(-h) of a half-space that contains the C-obstacle, at the distance h (in standard deviations)
  /// of its nearest point. Nearly exact for bodies larger than the displacement.
  double half_space = 1.0;

  /// Mass of the tightest box, of two orientations, around the whitened C-obstacle.
  double whitened_box = 1.0;

  /// The divergence-theorem bound of Algorithm 1 with the field factor 1/(4π) and the closed-form
  /// integral over every face. Nearly exact for bodies smaller than the displacement.
  double divergence = 1.0;

  /// Unit vector from the mean towards the C-obstacle in the whitened frame, along which the
  /// density was relaxed. Zero if the displacement has fewer than three directions.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// ConvexPCD, Algorithm 1 of the paper: upper bounds on the probability that `a`, displaced by
/// `displacement` (world frame, metres, relative to `b`), touches `b`.
///
/// Structure is used where it is known: 15 pairs of planes for two boxes (3 if their axes agree),
/// 11 for two triangles, merged faces for polytopes. A curved body enters the half-space and box
/// bounds by its own support function, the divergence bound by a polytope around it (two spheres:
/// exactly). A displacement of rank below 3 is handled by the section of the C-obstacle that it can
/// reach. \throws InvalidPose if a pose is not finite or not rigid
ConvexPcdBounds convexPcd(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                          const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement);

/// The probability itself, certified. The bounds differ by a rounding margin only for two bodies
/// with flat sides, for two balls, and, where the displacement has rank 3, for bodies rounded by a
/// ball (spheres, capsules, RSS) or ellipsoids beside bodies with flat sides, and the former beside
/// each other. Other curved bodies, and all of them under rank 2 or where one deviation is tiny
/// beside another, differ by about 1e-6 of themselves or less where the C-obstacle is known, else
/// they are the masses of polytopes inside and around it, which get closer as the resolution of the
/// bodies grows. \throws InvalidPose if a pose is not finite or not rigid
Bounds convexPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement);

}  // namespace fcl_prob
