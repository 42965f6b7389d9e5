// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random pairs of shapes with axes.
#pragma once

#include <Eigen/Geometry>

#include "fcl_prob/gaussian_displacement.h"
#include "random_bodies.h"
#include "shapes.h"

namespace fcl_prob_test {

/// Two shapes about parallel axes, the displacement being as wide in all directions across them.
struct CoaxialPair {
  explicit CoaxialPair(RandomBodies& random)
      : radius(random.uniform(0.2, 1.0)),
        length(random.uniform(0.4, 2.0)),
        other(random.uniform(0.1, 0.8)),
        longer(random.uniform(0.3, 2.0)),
        sigma(random.uniform(0.3, 1.0)),
        sigma_along(random.uniform(0.3, 1.0)),
        across(random.uniform(0.0, 5.0)),
        along(random.uniform(-3.0, 3.0)) {}

  fcl_prob::GaussianDisplacement error() const {
    return fcl_prob::GaussianDisplacement::fromStandardDeviations({sigma, sigma, sigma_along});
  }

  double radius, length, other, longer;  ///< metres
  double sigma, sigma_along;
  double across, along;  ///< where the second one is
};

/// Two poses whose z axes are at an angle, and a displacement.
struct TiltedPair {
  TiltedPair(double angle, RandomBodies& random)
      : error(randomDisplacement(random, 0.1, 0.6)),
        pose_a(random.pose(0.2)),
        pose_b(random.pose(0.0)) {
    pose_b.linear() =
        pose_a.linear() * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
    pose_b.translation() = random.uniform(0.0, 2.0) * random.direction();
  }

  fcl_prob::GaussianDisplacement error;
  Eigen::Isometry3d pose_a, pose_b;
};

}  // namespace fcl_prob_test
