// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One geometry of each of FCL's types, and random poses and displacements for them.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "random_bodies.h"

namespace fcl_prob_test {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

struct NamedGeometry {
  std::string name;
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
};

/// Box, Sphere, Ellipsoid, Capsule, Cone, Cylinder, Convex, TriangleP: about 1 m wide.
std::vector<NamedGeometry> boundedShapes();

/// Two small meshes (not convex), in trees of different bounding volumes.
std::vector<NamedGeometry> meshes();

/// A Convex that is the hull of random points on a sphere.
std::shared_ptr<fcl::CollisionGeometryd> randomConvex(int points, double radius, unsigned seed);

/// An OcTree with random occupied and free cells in a ball.
std::shared_ptr<fcl::CollisionGeometryd> randomOcTree(int cells, double resolution, double radius,
                                                      unsigned seed);

/// Standard deviations between `least` and `most` (metres, log-uniform), random axes, zero mean.
fcl_prob::GaussianDisplacement randomDisplacement(RandomBodies& random, double least, double most);

}  // namespace fcl_prob_test
