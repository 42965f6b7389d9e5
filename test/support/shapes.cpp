// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "shapes.h"

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include <Eigen/Geometry>
#include <cmath>

#include "fcl_prob/convex_parts.h"
#include "fcl_prob/convex_polytope.h"
#include "mesh_shapes.h"

namespace fcl_prob_test {

std::vector<NamedGeometry> boundedShapes() {
  return {{"Box", std::make_shared<fcl::Boxd>(0.5, 0.7, 0.9)},
          {"Sphere", std::make_shared<fcl::Sphered>(0.5)},
          {"Ellipsoid", std::make_shared<fcl::Ellipsoidd>(0.3, 0.4, 0.6)},
          {"Capsule", std::make_shared<fcl::Capsuled>(0.25, 0.6)},
          {"Cone", std::make_shared<fcl::Coned>(0.4, 0.9)},
          {"Cylinder", std::make_shared<fcl::Cylinderd>(0.3, 0.8)},
          {"Convex", randomConvex(12, 0.6, 7)},
          {"TriangleP", std::make_shared<fcl::TrianglePd>(Eigen::Vector3d(0.5, 0.1, 0.0),
                                                          Eigen::Vector3d(-0.4, 0.4, 0.1),
                                                          Eigen::Vector3d(-0.2, -0.5, -0.1))}};
}

std::vector<NamedGeometry> meshes() {
  return {{"BVHModel<OBBRSS>", makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 5, 8, 3))},
          {"BVHModel<AABB>", makeModel<fcl::AABBd>(torusMesh(0.4, 0.15, 8, 5))}};
}

std::shared_ptr<fcl::CollisionGeometryd> randomConvex(int points, double radius, unsigned seed) {
  RandomBodies random(seed);
  return fcl_prob::convexGeometry(fcl_prob::convexHull(random.onSphere(points, radius)));
}

std::shared_ptr<fcl::CollisionGeometryd> randomOcTree(int cells, double resolution, double radius,
                                                      unsigned seed) {
  RandomBodies random(seed);
  const auto tree = std::make_shared<octomap::OcTree>(resolution);
  for (int i = 0; i < cells; ++i) {
    const Eigen::Vector3d p = radius * std::cbrt(random.uniform(0.0, 1.0)) * random.direction();
    tree->updateNode(p.x(), p.y(), p.z(), i % 3 != 0);
  }
  return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
}

fcl_prob::GaussianDisplacement randomDisplacement(RandomBodies& random, double least, double most) {
  const double x = random.logUniform(least, most);
  const double y = random.logUniform(least, most);
  const double z = random.logUniform(least, most);
  return fcl_prob::GaussianDisplacement::fromStandardDeviations({x, y, z}, random.quaternion());
}

}  // namespace fcl_prob_test
