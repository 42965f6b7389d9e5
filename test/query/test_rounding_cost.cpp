// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the margins for rounding cost where nothing is extreme.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include "catch.h"
#include "fcl_prob/fcl_prob.h"
#include "mesh_shapes.h"
#include "random_bodies.h"
#include "shapes.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;

constexpr double kMostCost = 1e-9;

double relativeWidth(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b,
                     const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                     const ProbabilityRequest& request = {}) {
  ProbabilityResult result;
  collisionProbability(&a, fcl::Transform3d::Identity(), &b, pose_b, displacement, request, result);
  CHECK(result.status != ProbabilityStatus::cell_limit);
  if (*result.upper < 1e-12) return 0;  // not ordinary
  return (*result.upper - *result.lower) / *result.upper;
}

struct Widths {
  double worst = 0;
  int costly = 0;  // above kMostCost
};

// Sizes of about 1, standard deviations from 0.05 to 2, gaps of up to 3 of them.
template <class Next>
Widths widthsOf(int count, const Next& next) {
  RandomBodies random(5);
  Widths widths;
  int ordinary = 0;
  for (int i = 0; i < count; ++i) {
    const GaussianDisplacement displacement = randomDisplacement(random, 0.05, 2);
    fcl::Transform3d pose = random.pose(0.0);
    pose.translation() =
        (1 + random.uniform(0, 3) * displacement.standardDeviations()[2]) * random.direction();
    const double width = next(random, pose, displacement);
    ordinary += width > 0;
    widths.worst = std::max(widths.worst, width);
    widths.costly += width >= kMostCost;
  }
  CHECK(3 * ordinary > count);
  return widths;
}

}  // namespace

TEST_CASE("margins for rounding cost less than 1e-9 of P for ordinary convex pairs") {
  const auto boxes = [](RandomBodies& random, const fcl::Transform3d& pose,
                        const GaussianDisplacement& displacement) {
    const fcl::Boxd a(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1));
    return relativeWidth(a, fcl::Boxd(0.5, 0.7, 0.9), pose, displacement);
  };
  CHECK(widthsOf(300, boxes).worst < kMostCost);
  const auto hulls = [](RandomBodies& random, const fcl::Transform3d& pose,
                        const GaussianDisplacement& displacement) {
    const auto hull = randomConvex(10, 0.5, static_cast<unsigned>(random.integer(1, 1000)));
    return relativeWidth(*hull, fcl::Boxd(0.5, 0.7, 0.9), pose, displacement);
  };
  CHECK(widthsOf(100, hulls).worst < kMostCost);
  const auto spheres = [](RandomBodies& random, const fcl::Transform3d& pose,
                          const GaussianDisplacement& displacement) {
    const auto isotropic = GaussianDisplacement::fromStandardDeviations(
        Eigen::Vector3d::Constant(displacement.standardDeviations()[0]));
    return relativeWidth(fcl::Sphered(random.uniform(0.2, 0.6)), fcl::Sphered(0.5), pose,
                         isotropic);
  };
  CHECK(widthsOf(300, spheres).worst < kMostCost);
}

TEST_CASE("margins for rounding cost less than 1e-9 of P for half-spaces and resolved meshes") {
  const auto mesh = makeModel<fcl::OBBRSSd>(boxMesh({0.5, 0.7, 0.9}));
  const fcl::Halfspaced halfspace(Eigen::Vector3d(1, 2, 2) / 3, -1.0);
  const auto ofMesh = [&](RandomBodies&, const fcl::Transform3d& pose,
                          const GaussianDisplacement& displacement) {
    const fcl::Transform3d turned(pose.linear());
    return relativeWidth(halfspace, *mesh, turned, displacement);
  };
  CHECK(widthsOf(100, ofMesh).worst < kMostCost);

  // Along a line the partition resolves everything.
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.relative_tolerance = 1e-14;
  request.absolute_tolerance = 0;
  const auto other = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 5, 8, 3));
  const auto resolved = [&](RandomBodies& random, const fcl::Transform3d& pose,
                            const GaussianDisplacement& displacement) {
    const auto line = GaussianDisplacement::fromStandardDeviations(
        {displacement.standardDeviations()[0], 0, 0}, random.quaternion());
    return relativeWidth(*mesh, *other, pose, line, request);
  };
  // A line that grazes an edge makes more of every rounding.
  const Widths widths = widthsOf(100, resolved);
  CHECK(widths.costly <= 2);
  CHECK(widths.worst < 100 * kMostCost);
}
