// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/nearest.h"

#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>

#include "catch.h"
#include "convex/pair_obstacle.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob::detail;
using fcl_prob::ConvexBody;
using fcl_prob::GaussianDisplacement;

/// The best half-space around many random directions: an independent lower bound of the distance.
double distanceBySearch(const CObstacle& v, RandomBodies& random) {
  Eigen::Vector3d best = random.direction();
  double distance = -v.support(-best);
  double spread = 1.0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d d = (best + spread * random.normalVector()).normalized();
    const double candidate = -v.support(-d);
    if (candidate > distance) {
      distance = candidate;
      best = d;
    } else {
      spread = std::max(1e-6, spread * 0.997);
    }
  }
  return distance;
}

TEST_CASE("the direction of closest approach of polytopes and curved bodies") {
  RandomBodies random(41);
  int apart = 0;
  int inside = 0;
  for (int i = 0; i < 120; ++i) {
    const ConvexBody a(random.cloud(random.integer(3, 12), random.logUniform(0.1, 10)));
    const ConvexBody b = i % 3 == 0   ? ConvexBody(fcl::Capsuled(random.uniform(0.1, 1), 1))
                         : i % 3 == 1 ? ConvexBody(fcl::Cylinderd(random.uniform(0.1, 1), 1))
                                      : ConvexBody(random.cloud(8, 1));
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        {random.logUniform(0.1, 1), random.logUniform(0.1, 1), random.logUniform(0.1, 1)},
        random.quaternion());
    const Eigen::Isometry3d pose_a = random.pose(1.0);
    const Eigen::Isometry3d pose_b = random.pose(6.0);
    const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
    const PairObstacle v(frame, a.set(), b.set());
    ObstacleScratch scratch;
    v->outerFaces(scratch);
    const Separation separation = separationOf(scratch.faces);
    const double expected = distanceBySearch(*v, random);
    if (expected <= 0.01) {
      ++inside;
      continue;
    }
    ++apart;
    double found = separation.nearest.isZero() ? -1.0 : -v->support(-separation.nearest);
    if (!v->isPolytope()) {
      const Eigen::Vector3d gjk = gjkDirection(*v);
      REQUIRE_FALSE(gjk.isZero());
      CHECK(gjk.norm() == Approx(1.0));
      found = std::max(found, -v->support(-gjk));
    }
    CHECK(found >= expected - 1e-6 * (1.0 + expected));
  }
  CHECK(apart > 50);
  CHECK(inside > 10);
}

TEST_CASE("the nearest point of a ball under an anisotropic displacement") {
  RandomBodies random(42);
  for (int i = 0; i < 200; ++i) {
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        {random.logUniform(1e-3, 1), random.logUniform(1e-3, 1), random.logUniform(1e-3, 1)},
        random.quaternion());
    const fcl_prob::detail::RoundedZonotope ball{Zonotope(Eigen::Vector3d::Zero()),
                                                 random.logUniform(1e-3, 1)};
    Eigen::Isometry3d pose_b = Eigen::Isometry3d::Identity();
    pose_b.translation() = (2.0 * ball.radius + random.logUniform(1e-3, 3)) * random.direction();
    const PairFrame frame(displacement, Eigen::Isometry3d::Identity(), 1.0, pose_b, 1.0);
    const ZonotopeObstacle v(frame, ball, ball);
    const auto ellipsoid = v.ellipsoid();
    REQUIRE(ellipsoid);
    const Eigen::Vector3d nearest = ellipsoid->nearestPoint(frame);
    // It is on the ball, and the plane through it across its direction supports the ball.
    const Eigen::Vector3d world = frame.whitening.inverse() * nearest;
    CHECK((world - ellipsoid->centre).norm() == Approx(ellipsoid->radius));
    CHECK(-v.support(-nearest.normalized()) == Approx(nearest.norm()).epsilon(1e-9));
  }
}

}  // namespace
