// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random convex pairs of all sizes and distances, with their probabilities.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "fcl_prob/convex_body.h"
#include "fcl_prob/gaussian_displacement.h"
#include "random_bodies.h"

namespace fcl_prob_test {

/// Bodies in the whitened frame (of which the world is an affine image), scaled and placed so that
/// the C-obstacle is at a given distance from the mean.
struct ConvexPairCase {
  fcl_prob::ConvexBody a;
  fcl_prob::ConvexBody b;
  Eigen::Isometry3d pose_a;
  Eigen::Isometry3d pose_b;
  fcl_prob::GaussianDisplacement displacement;
  double size;        ///< of the C-obstacle, standard deviations
  double distance;    ///< from the mean, standard deviations; 0 if it is inside
  double mass;        ///< P
  double mass_error;  ///< P is known this well
};

/// Two boxes whose axes are those of the displacement: P is a product.
ConvexPairCase alignedBoxes(RandomBodies& random);

/// Two boxes in any orientation.
ConvexPairCase turnedBoxes(RandomBodies& random);

/// The hulls of some points each; two triangles if `count` is 3.
ConvexPairCase hulls(RandomBodies& random, int count_a, int count_b);

}  // namespace fcl_prob_test
