// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/convex_pcd.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "bounds/convex_bound.h"
#include "catch.h"
#include "convex_pair_cases.h"
#include "face_geometry.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "poses.h"
#include "random_bodies.h"
#include "slice_cubature.h"

namespace {

using namespace fcl_prob_test;
using fcl_prob::ConvexBody;
using fcl_prob::ConvexPcdBounds;
using fcl_prob::GaussianDisplacement;

/// Two cubes whose C-obstacle has this side and starts at this distance along x.
ConvexPcdBounds cubes(double side, double distance) {
  const ConvexBody cube(fcl::Boxd(0.5 * side, 0.5 * side, 0.5 * side));
  const GaussianDisplacement unit(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());
  return convexPcd(cube, at({0, 0, 0}), cube, at({distance + 0.5 * side, 0, 0}), unit);
}

double cubeMass(double side, double distance) {
  const double across = fcl_prob::normalIntervalMass(-0.5 * side, 0.5 * side);
  return across * across * fcl_prob::normalIntervalMass(distance, distance + side);
}

TEST_CASE("small bodies need the divergence bound, large ones the half-space") {
  const double small = cubeMass(0.3, 3.0);
  CHECK(cubes(0.3, 3.0).half_space / small == Approx(109.6).epsilon(1e-3));
  CHECK(cubes(0.3, 3.0).divergence / small == Approx(1.0075).epsilon(1e-4));
  const double large = cubeMass(10.0, 3.0);
  CHECK(cubes(10.0, 3.0).half_space / large == Approx(1.0).epsilon(1e-5));
  CHECK(cubes(10.0, 3.0).divergence / large == Approx(15.92).epsilon(1e-3));
  CHECK(cubes(10.0, 3.0).direction.isApprox(Eigen::Vector3d::UnitX()));
}

TEST_CASE("a half-space between two bodies bounds P, and is close where they are large") {
  RandomBodies random(31);
  int useful = 0;
  for (int i = 0; i < 600; ++i) {
    const ConvexPairCase pair = i % 3 == 0   ? alignedBoxes(random)
                                : i % 3 == 1 ? turnedBoxes(random)
                                             : hulls(random, random.integer(3, 12), 9);
    const double upper = fcl_prob::detail::halfSpaceUpper(pair.a, pair.pose_a, pair.b, pair.pose_b,
                                                          pair.displacement);
    CAPTURE(i, pair.size, pair.distance, pair.mass, pair.mass_error, upper);
    CHECK(upper >= pair.mass - pair.mass_error);
    CHECK(upper <= 1.0);
    // What more iterations than those of GJK find is mostly no better.
    const double best =
        convexPcd(pair.a, pair.pose_a, pair.b, pair.pose_b, pair.displacement).half_space;
    useful += upper <= best * (1.0 + 1e-6) + 1e-290;
  }
  CHECK(useful > 500);
  const ConvexBody wall(fcl::Boxd(1e6, 1e6, 1e6));
  const GaussianDisplacement unit(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());
  for (double gap = 0.5; gap < 36.0; gap += 0.5) {
    Eigen::Isometry3d turned = Eigen::Isometry3d(random.quaternion());
    const Eigen::Isometry3d far = turned * at({1e6 + gap, 0, 0});
    const double upper = fcl_prob::detail::halfSpaceUpper(wall, turned, wall, far, unit);
    CAPTURE(gap, upper);
    // The gap is known to an ε of the positions; how well GJK finds it is no promise.
    CHECK(upper >= fcl_prob::normalTailMass(gap + 1e-9));
    CHECK(upper <= fcl_prob::normalTailMass(0.99 * gap));
  }
}

TEST_CASE("the mean inside, touching, and very far away") {
  CHECK(cubes(1000.0, -500.0).least == 1.0);
  CHECK(cubes(2.0, -1.0).least >= cubeMass(2.0, -1.0));
  CHECK(cubes(2.0, -1.0).least < 0.6);
  CHECK(cubes(1e-3, -5e-4).least == Approx(cubeMass(1e-3, -5e-4)).epsilon(1e-5));
  CHECK(cubes(1.0, 0.0).least >= cubeMass(1.0, 0.0));
  CHECK(cubes(1.0, 30.0).least >= cubeMass(1.0, 30.0));
  CHECK(cubes(1.0, 30.0).least <= 1.2 * cubeMass(1.0, 30.0));
  const double beyond = cubes(1.0, 1e6).least;
  CHECK(beyond >= 0.0);
  CHECK(beyond <= 1e-299);
}

TEST_CASE("swapping the bodies, turning the world and changing the unit leave the bounds") {
  RandomBodies random(82);
  for (int i = 0; i < 100; ++i) {
    const auto points_a = random.cloud(random.integer(3, 9), 1.0);
    const auto points_b = random.cloud(random.integer(3, 9), 1.0);
    const ConvexBody a(points_a);
    const ConvexBody b(points_b);
    const Eigen::Isometry3d pose_a = random.pose(1.0);
    const Eigen::Isometry3d pose_b = random.pose(3.0);
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        {random.logUniform(0.1, 1), random.logUniform(0.1, 1), random.logUniform(0.1, 1)},
        random.quaternion(), 0.3 * random.normalVector());
    const double expected = convexPcd(a, pose_a, b, pose_b, displacement).least;
    CHECK(convexPcd(b, pose_b, a, pose_a, displacement.reversed()).least ==
          Approx(expected).epsilon(1e-7));

    const Eigen::Isometry3d turn(random.quaternion());
    CHECK(
        convexPcd(a, turn * pose_a, b, turn * pose_b, displacement.rotated(turn.linear())).least ==
        Approx(expected).epsilon(1e-7));

    const double scale = random.logUniform(1e-3, 1e3);
    const auto scaled = [scale](std::vector<Eigen::Vector3d> points) {
      for (Eigen::Vector3d& p : points) p *= scale;
      return ConvexBody(points);
    };
    Eigen::Isometry3d scaled_a = pose_a;
    Eigen::Isometry3d scaled_b = pose_b;
    scaled_a.translation() *= scale;
    scaled_b.translation() *= scale;
    const GaussianDisplacement in_other_unit(scale * displacement.mean(),
                                             scale * scale * displacement.covariance());
    CHECK(convexPcd(scaled(points_a), scaled_a, scaled(points_b), scaled_b, in_other_unit).least ==
          Approx(expected).epsilon(1e-7));
  }
}

/// P by plain sampling of the definition through support functions is not possible; through points
/// of a fine polytope inside it is: a lower bound of P.
TEST_CASE("curved bodies: bounds are above the mass of polytopes inside them, and close") {
  RandomBodies random(83);
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const double r = random.logUniform(0.02, 20.0);
    const double length = random.logUniform(0.02, 20.0);
    std::unique_ptr<fcl::CollisionGeometryd> shape;
    switch (i % 5) {
      case 0:
        shape = std::make_unique<fcl::Sphered>(r);
        break;
      case 1:
        shape = std::make_unique<fcl::Capsuled>(r, length);
        break;
      case 2:
        shape = std::make_unique<fcl::Cylinderd>(r, length);
        break;
      case 3:
        shape = std::make_unique<fcl::Coned>(r, length);
        break;
      default:
        shape = std::make_unique<fcl::Ellipsoidd>(r, length, 0.5 * (r + length));
    }
    const ConvexBody curved(*shape);
    std::vector<Eigen::Vector3d> inside;
    for (int k = 0; k < 150; ++k) inside.push_back(curved.supportPoint(random.direction()));
    const std::vector<Eigen::Vector3d> others = random.cloud(6, random.logUniform(0.1, 10));
    const Eigen::Vector3d sigma(random.logUniform(0.3, 1), random.logUniform(0.3, 1),
                                random.logUniform(0.3, 1));
    const auto displacement = GaussianDisplacement::fromStandardDeviations(sigma);
    const Eigen::Isometry3d pose_a = random.pose(1.0);
    Eigen::Isometry3d pose_b = random.pose(1.0);
    pose_b.translation() += random.uniform(0.0, 1.5) * (r + length) * random.direction();

    std::vector<Eigen::Vector3d> placed_a;
    std::vector<Eigen::Vector3d> placed_b;
    for (const Eigen::Vector3d& p : inside) placed_a.push_back((pose_a * p).cwiseQuotient(sigma));
    for (const Eigen::Vector3d& p : others) placed_b.push_back((pose_b * p).cwiseQuotient(sigma));
    const double mass = massBySlices(allDifferences(placed_b, placed_a));
    const ConvexPcdBounds above =
        convexPcd(curved, pose_a, ConvexBody(others), pose_b, displacement);
    INFO("P of the points inside " << mass);
    CHECK(above.half_space >= mass * (1 - kSliceCubatureError));
    CHECK(above.whitened_box >= mass * (1 - kSliceCubatureError));
    CHECK(above.divergence >= mass * (1 - kSliceCubatureError));
    const ConvexPcdBounds of_points =
        convexPcd(ConvexBody(inside), pose_a, ConvexBody(others), pose_b, displacement);
    if (std::max(r, length) < 3.0 && mass > 1e-9) {  // where so many points are a good likeness
      ++compared;
      CHECK(above.least <= of_points.least * 2.0);
    }
  }
  CHECK(compared > 15);
}

TEST_CASE("two spheres and an isotropic displacement: above the mass of the ball") {
  RandomBodies random(84);
  for (int i = 0; i < 200; ++i) {
    const double sigma = random.logUniform(1e-3, 1.0);
    const GaussianDisplacement displacement(Eigen::Vector3d::Zero(),
                                            sigma * sigma * Eigen::Matrix3d::Identity());
    const double radius = sigma * random.logUniform(1e-3, 1e3);
    const double distance = sigma * random.uniform(0.0, 8.0);
    const ConvexBody sphere(fcl::Sphered(0.5 * radius));
    const ConvexPcdBounds bounds = convexPcd(
        sphere, at({0, 0, 0}), sphere, at((radius + distance) * random.direction()), displacement);
    // Of the ball's mass only the outermost layers of a few sections are counted here.
    const double h = distance / sigma;
    CHECK(bounds.half_space == Approx(fcl_prob::normalTailMass(h)).epsilon(1e-6));
    CHECK(bounds.divergence > 0.0);
    CHECK(bounds.least <= bounds.half_space);
  }
}

TEST_CASE("bad poses are refused") {
  const ConvexBody cube(fcl::Boxd(1, 1, 1));
  Eigen::Isometry3d bad = at({0, 0, 0});
  bad.linear()(0, 0) = 2.0;
  CHECK_THROWS_AS(convexPcd(cube, bad, cube, at({0, 0, 0}), GaussianDisplacement()),
                  fcl_prob::InvalidPose);
  CHECK_THROWS_AS(
      convexPcd(cube, at({0, 0, 0}), cube, at({std::numeric_limits<double>::quiet_NaN(), 0, 0}),
                GaussianDisplacement()),
      fcl_prob::InvalidPose);
}

}  // namespace
