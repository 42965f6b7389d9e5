// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One geometry of each of FCL's types, and random poses and displacements for them.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob_test {

struct NamedGeometry {
  std::string name;
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
};

/// Box, Sphere, Ellipsoid, Capsule, Cone, Cylinder, Convex, TriangleP: about 1 m wide.
std::vector<NamedGeometry> boundedShapes();

/// Two small meshes (not convex), in trees of different bounding volumes.
std::vector<NamedGeometry> meshes();

/// A Convex that is the hull of random points in a ball.
std::shared_ptr<fcl::CollisionGeometryd> randomConvex(int points, double radius,
                                                      std::uint64_t seed);

Eigen::Matrix3d randomRotation(std::mt19937_64& generator);

Eigen::Vector3d randomDirection(std::mt19937_64& generator);

/// Standard deviations between `least` and `most` (metres, log-uniform), random axes, zero mean.
fcl_prob::GaussianDisplacement randomDisplacement(std::mt19937_64& generator, double least,
                                                  double most);

}  // namespace fcl_prob_test
