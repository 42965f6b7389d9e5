// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Displacements that do not move in every direction.
#include <fcl/geometry/shape/box.h>

#include <Eigen/Geometry>

#include "catch.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/normal_mass.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using fcl_prob::ConvexBody;
using fcl_prob::ConvexPcdBounds;
using fcl_prob::GaussianDisplacement;

struct AlignedCase {
  ConvexPcdBounds bounds;
  double mass;
};

/// Boxes along the axes of a displacement whose last standard deviations are zero.
AlignedCase alignedCase(RandomBodies& random, int rank) {
  const Eigen::Quaterniond axes = random.quaternion();
  Eigen::Vector3d sigma;
  for (int k = 0; k < 3; ++k) sigma[k] = k < rank ? random.logUniform(0.01, 1) : 0.0;
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;
  double mass = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double unit = k < rank ? sigma[k] : 1.0;
    lower[k] = unit * random.uniform(-4.0, 3.0);
    if (k >= rank && random.integer(0, 9)) lower[k] = -0.5;
    upper[k] = lower[k] + unit * random.logUniform(0.1, 30.0);
    mass *= k < rank ? fcl_prob::normalIntervalMass(lower[k] / sigma[k], upper[k] / sigma[k])
                     : (lower[k] <= 0.0 && upper[k] >= 0.0 ? 1.0 : 0.0);
  }
  const Eigen::Vector3d sides = upper - lower;
  const ConvexBody a(fcl::Boxd(0.3 * sides));
  const ConvexBody b(fcl::Boxd(0.7 * sides));
  const Eigen::Isometry3d pose_a(axes);
  Eigen::Isometry3d pose_b(axes);
  pose_b.translation() = axes * Eigen::Vector3d(0.5 * (lower + upper));
  const auto displacement = GaussianDisplacement::fromStandardDeviations(sigma, axes);
  REQUIRE(displacement.rank() == rank);
  return {convexPcd(a, pose_a, b, pose_b, displacement), mass};
}

TEST_CASE("boxes that can only move along some of their axes") {
  RandomBodies random(91);
  int missed = 0;
  for (int rank = 0; rank <= 2; ++rank) {
    for (int i = 0; i < 400; ++i) {
      const AlignedCase c = alignedCase(random, rank);
      INFO("rank " << rank << " P " << c.mass << " least " << c.bounds.least);
      CHECK(c.bounds.least >= c.mass * (1 - 1e-12));
      CHECK(c.bounds.half_space >= c.mass * (1 - 1e-12));
      CHECK(c.bounds.divergence >= c.mass * (1 - 1e-12));
      CHECK(c.bounds.least <= c.mass * (1 + 1e-6));  // the box is exact
      if (c.mass == 0.0) {
        ++missed;
        CHECK(c.bounds.least == 0.0);
      }
    }
  }
  CHECK(missed > 50);
}

TEST_CASE("a body cut by the plane of motion at an angle") {
  // The C-obstacle of a point and a cube turned by 45 degrees about y, cut by the plane z = 0.2: a
  // rectangle of half-width sqrt(0.5) - 0.2.
  const ConvexBody point(std::vector<Eigen::Vector3d>{Eigen::Vector3d::Zero()});
  const ConvexBody cube(fcl::Boxd(1, 1, 1));
  Eigen::Isometry3d pose_b(Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitY()));
  pose_b.translation().z() = -0.2;
  const auto displacement = GaussianDisplacement::fromStandardDeviations({1.0, 1.0, 0.0});
  const ConvexPcdBounds bounds =
      convexPcd(point, Eigen::Isometry3d::Identity(), cube, pose_b, displacement);
  const double half = std::sqrt(0.5) - 0.2;
  const double mass =
      fcl_prob::normalIntervalMass(-half, half) * fcl_prob::normalIntervalMass(-0.5, 0.5);
  CHECK(bounds.least >= mass);
  CHECK(bounds.least <= mass * (1 + 1e-9));
  pose_b.translation().z() = -0.8;
  CHECK(convexPcd(point, Eigen::Isometry3d::Identity(), cube, pose_b, displacement).least == 0.0);
}

TEST_CASE("the exact mass of boxes turned by next to nothing, down to next to no thickness") {
  // The faces between those that are nearly parallel are as narrow as the turn is small, and their
  // normals are noise.
  RandomBodies random(93);
  const ConvexBody a(fcl::Boxd(0.4, 0.3, 0.2));
  for (int i = 0; i < 1500; ++i) {
    const int rank = random.integer(1, 3);
    const Eigen::Vector3d sigma(0.08, rank > 1 ? 0.05 : 0.0, rank > 2 ? 0.06 : 0.0);
    const double thickness = random.logUniform(1.0, 1e4) * (i % 4 ? 1e-5 : 1e-60);
    const double angle = random.logUniform(1e-16, 1e-9);
    Eigen::Isometry3d pose_a(Eigen::AngleAxisd(angle, random.direction()));
    pose_a.translation().x() = 0.5;
    const fcl_prob::Bounds bounds = convexPairMass(
        a, pose_a, ConvexBody(fcl::Boxd(0.4, 0.4, thickness)), Eigen::Isometry3d::Identity(),
        GaussianDisplacement::fromStandardDeviations(sigma));
    const double height = 0.1 + 0.5 * thickness;
    double mass = fcl_prob::normalIntervalMass(1.25, 11.25);
    if (rank > 1) mass *= fcl_prob::normalIntervalMass(-7.0, 7.0);
    if (rank > 2) mass *= fcl_prob::normalIntervalMass(-height / 0.06, height / 0.06);
    INFO("rank " << rank << " thickness " << thickness << " angle " << angle);
    CHECK(bounds.lower <= bounds.upper);
    // The turn moves the sides by half the width of the bodies, 7 standard deviations.
    CHECK(bounds.lower <= mass * (1 + 20 * angle + 1e-12));
    CHECK(bounds.upper >= mass * (1 - 20 * angle - 1e-12));
    CHECK(bounds.lower >= mass * (1 - 1e-6));
    CHECK(bounds.upper <= mass * (1 + 1e-6));
  }
}

TEST_CASE("low rank is the limit of a small standard deviation") {
  RandomBodies random(92);
  int positive = 0;
  for (int i = 0; i < 150; ++i) {
    const ConvexBody a(random.cloud(random.integer(3, 7), 1.0));
    const ConvexBody b(random.cloud(random.integer(3, 7), 1.0));
    const Eigen::Isometry3d pose_a = random.pose(0.5);
    const Eigen::Isometry3d pose_b = random.pose(0.5);
    const int rank = random.integer(1, 2);
    const Eigen::Vector3d sigma(0.5, rank == 2 ? 0.3 : 0.0, 0.0);
    const Eigen::Vector3d nearly = sigma.cwiseMax(1e-7);
    const Eigen::Quaterniond axes = random.quaternion();
    const double limit =
        convexPcd(a, pose_a, b, pose_b, GaussianDisplacement::fromStandardDeviations(sigma, axes))
            .least;
    const double close =
        convexPcd(a, pose_a, b, pose_b, GaussianDisplacement::fromStandardDeviations(nearly, axes))
            .least;
    // Both bound (nearly) the same P. That of the section is hardly ever the looser one, because
    // the other sees a body that is endless across the section.
    CHECK(limit <= close * 1.1);
    positive += limit > 0.0;
  }
  CHECK(positive > 50);
}

}  // namespace
