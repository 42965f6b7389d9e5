// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which pairs fcl::collide answers, checked against FCL itself.
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>
#include <fcl/narrowphase/collision.h>

#include <iostream>
#include <sstream>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "mesh_shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

Geometry octree() {
  auto tree = std::make_shared<octomap::OcTree>(0.2);
  tree->updateNode(0.1, 0.1, 0.1, true);
  return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
}

Geometry tetrahedron() {
  const std::vector<Eigen::Vector3d> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<int> faces = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2};
  return std::make_shared<fcl::Convexd>(
      std::make_shared<const std::vector<Eigen::Vector3d>>(vertices), 4,
      std::make_shared<const std::vector<int>>(faces));
}

std::vector<Geometry> oneOfEachType() {
  const TriangleMesh box = boxMesh({1, 1, 1});
  return {makeModel<fcl::AABBd>(box),
          makeModel<fcl::OBBd>(box),
          makeModel<fcl::RSSd>(box),
          makeModel<fcl::kIOSd>(box),
          makeModel<fcl::OBBRSSd>(box),
          makeModel<fcl::KDOPd<16>>(box),
          makeModel<fcl::KDOPd<18>>(box),
          makeModel<fcl::KDOPd<24>>(box),
          std::make_shared<fcl::Boxd>(1, 1, 1),
          std::make_shared<fcl::Sphered>(1),
          std::make_shared<fcl::Ellipsoidd>(1, 1, 2),
          std::make_shared<fcl::Capsuled>(1, 1),
          std::make_shared<fcl::Coned>(1, 1),
          std::make_shared<fcl::Cylinderd>(1, 1),
          tetrahedron(),
          std::make_shared<fcl::Planed>(0, 0, 1, 0),
          std::make_shared<fcl::Halfspaced>(0, 0, 1, 0),
          std::make_shared<fcl::TrianglePd>(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                            Eigen::Vector3d(0, 1, 0)),
          octree()};
}

/// FCL 0.7 calls a null pointer for these pairs; a tree of another bounding volume avoids it.
bool fclCrashesOnTree(const Geometry& a, const Geometry& b) {
  const auto rebuilt = [](const Geometry& g) {
    const auto type = g->getNodeType();
    return type == fcl::BV_AABB || type == fcl::BV_KDOP16 || type == fcl::BV_KDOP18 ||
           type == fcl::BV_KDOP24;
  };
  const auto flat = [](const Geometry& g) {
    return g->getNodeType() == fcl::GEOM_PLANE || g->getNodeType() == fcl::GEOM_HALFSPACE;
  };
  return (rebuilt(a) && flat(b)) || (flat(a) && rebuilt(b));
}

/// And for this one, which nothing avoids.
bool fclCrashesOnConvexAndPlane(const Geometry& a, const Geometry& b) {
  const auto types = std::minmax({a->getNodeType(), b->getNodeType()});
  return types.first == fcl::GEOM_CONVEX && types.second == fcl::GEOM_PLANE;
}

/// FCL says it only on cerr.
bool fclWarns(const Geometry& a, const Geometry& b) {
  std::ostringstream captured;
  std::streambuf* const original = std::cerr.rdbuf(captured.rdbuf());
  const fcl::Transform3d pose = fcl::Transform3d::Identity();
  fcl::CollisionResultd result;
  fcl::collide(a.get(), pose, b.get(), pose, fcl::CollisionRequestd(), result);
  std::cerr.rdbuf(original);
  return captured.str().find("not supported") != std::string::npos;
}

}  // namespace

TEST_CASE("support is claimed exactly for the pairs that FCL does not warn about") {
  const auto geometries = oneOfEachType();
  int supported = 0;
  for (const auto& a : geometries) {
    for (const auto& b : geometries) {
      INFO("node types " << a->getNodeType() << " and " << b->getNodeType());
      if (fclCrashesOnConvexAndPlane(a, b)) {
        CHECK_FALSE(fclSupportsPair(*a, *b));
      } else if (fclCrashesOnTree(a, b)) {
        CHECK(fclSupportsPair(*a, *b));
      } else {
        CHECK(fclSupportsPair(*a, *b) == !fclWarns(a, b));
      }
      supported += fclSupportsPair(*a, *b);
    }
  }
  CHECK(supported > 200);
  CHECK(supported < static_cast<int>(geometries.size() * geometries.size()));
}

TEST_CASE("pairs on which FCL crashes are answered through another tree") {
  const fcl::Transform3d pose = fcl::Transform3d::Identity();
  const auto displacement = GaussianDisplacement::fromStandardDeviations({1, 1, 1});
  ProbabilityRequest request;
  request.samples = 2000;
  int crashing = 0;
  for (const auto& a : oneOfEachType()) {
    for (const Geometry& b : {Geometry(std::make_shared<fcl::Halfspaced>(0, 0, 1, -1)),
                              Geometry(std::make_shared<fcl::Planed>(0, 0, 1, -1))}) {
      if (!fclCrashesOnTree(a, b)) continue;
      ++crashing;
      const bool half = b->getNodeType() == fcl::GEOM_HALFSPACE;
      const double expected =
          half ? 0.30853753872598690 : 0.30853753872598690 - 0.06680720126885807;
      for (bool swapped : {false, true}) {
        const auto result = swapped
                                ? monteCarloProbability(*b, pose, *a, pose, displacement, request)
                                : monteCarloProbability(*a, pose, *b, pose, displacement, request);
        CHECK(std::abs(*result.estimate - expected) < 4 * *result.standard_error);
      }
    }
  }
  CHECK(crashing == 8);
}

TEST_CASE("unsupported pairs are refused, not answered with 0") {
  const auto obb = makeModel<fcl::OBBd>(boxMesh({1, 1, 1}));
  const auto aabb = makeModel<fcl::AABBd>(boxMesh({1, 1, 1}));
  const fcl::Transform3d pose = fcl::Transform3d::Identity();
  const auto displacement = GaussianDisplacement::fromStandardDeviations({1, 1, 1});
  CHECK_THROWS_AS(monteCarloProbability(*obb, pose, *aabb, pose, displacement, {}),
                  UnsupportedGeometry);
  CHECK_THROWS_WITH(
      monteCarloProbability(*obb, pose, *aabb, pose, displacement, {}),
      Catch::Matchers::Contains("BVHModel<OBB>") && Catch::Matchers::Contains("BVHModel<AABB>"));
}
