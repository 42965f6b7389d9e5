// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Flat displacements: against what is known of balls, swept solids and slabs.
#include "exact/layered_mass.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>

#include <memory>

#include "catch.h"
#include "exact/curved_pair.h"
#include "fcl_prob/convex_pcd.h"
#include "poses.h"
#include "random_bodies.h"
#include "section_truth.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;
using Eigen::Vector3d;
using Pose = Eigen::Isometry3d;

struct FlatPair {
  ConvexBody a, b;
  Pose pose_a, pose_b;
  GaussianDisplacement displacement;

  Bounds mass() const { return convexPairMass(a, pose_a, b, pose_b, displacement); }

  Bounds layered(const detail::LayeredEffort& effort) const {
    const auto section = [this](const fcl::Transform3d& at_a, const fcl::Transform3d& at_b,
                                const GaussianDisplacement& across) {
      return convexPairMass(a, at_a, b, at_b, across);
    };
    return detail::layeredMass(a, pose_a, b, pose_b, displacement, section, effort);
  }
};

void checkTells(const Bounds& mass, double truth, double truth_error, double width) {
  INFO(mass.lower << " to " << mass.upper << ", truth " << truth);
  CHECK(mass.lower <= truth * (1.0 + truth_error));
  CHECK(mass.upper >= truth * (1.0 - truth_error));
  CHECK(mass.width() <= width * mass.upper);
}

TEST_CASE("spheres under flat displacements: layers hold what quadrature over chords has") {
  RandomBodies random(9021);
  int told = 0;
  for (int k = 0; k < 40; ++k) {
    const double thin = random.logUniform(1e-7, 1e-4);
    FlatPair pair{
        ConvexBody(fcl::Sphered(0.4)), ConvexBody(fcl::Sphered(0.6)), random.pose(100.0),
        Pose::Identity(),
        GaussianDisplacement::fromStandardDeviations(
            {random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), thin}, random.quaternion())};
    const Vector3d across = pair.displacement.axes().col(0);
    const Vector3d thin_axis = pair.displacement.axes().col(2);
    pair.pose_b.translation() = pair.pose_a.translation() + random.uniform(0.0, 3.0) * across +
                                random.uniform(-0.7, 0.7) * thin_axis;
    pair.displacement = pair.displacement.withMean(0.1 * random.direction());
    const Bounds known = pair.mass(), layers = pair.layered({1e-9, 40});
    INFO(k << ", thin " << thin << ": " << known.lower << " to " << known.upper << ", layers "
           << layers.lower << " to " << layers.upper);
    CHECK(layers.lower <= known.upper);
    CHECK(layers.upper >= known.lower);
    told += layers.width() < 1e-8 * layers.upper ? 1 : 0;
  }
  CHECK(told >= 30);
}

/// Of a cylinder or cone swept by a ball, upright at a height z above the mean, seen at a distance
/// from its axis: where nearly nothing moves upwards.
double uprightMass(double half, double bottom, double top, double ball, double across, double z,
                   double sigma, double thin) {
  const double slant = std::hypot(2.0 * half, bottom - top);
  const double up = (bottom - top) / slant, out = 2.0 * half / slant;
  const auto radiusAt = [&](double h) {
    const double share = (h + half - ball * up) / (2.0 * half);
    return bottom + share * (top - bottom) + ball * out;
  };
  return integrateOver({-8.5, -4.0, 0.0, 4.0, 8.5}, [&](double t) {
    return densityAt(t) * discMassAt(across / sigma, radiusAt(thin * t - z) / sigma);
  });
}

TEST_CASE("cylinders and cones beside spheres, where next to nothing moves along the axis") {
  RandomBodies random(9022);
  for (int k = 0; k < 24; ++k) {
    const double radius = random.uniform(0.3, 1.0), length = random.uniform(1.0, 3.0);
    const double ball = random.uniform(0.1, 0.4), top = k % 2 ? 0.0 : radius;
    const double sigma = random.logUniform(0.02, 2.0);
    const double thin = 1e-3 * sigma * random.logUniform(1e-3, 1.0);
    const double across = random.uniform(0.0, 1.0) * radius + random.uniform(0.0, 5.0) * sigma;
    const double z = random.uniform(-0.2, 0.2) * length;
    const auto turn = random.quaternion();
    Pose pose = at(turn * Vector3d(across, 0.0, z));
    pose.linear() = turn.toRotationMatrix();
    const ConvexBody shape =
        k % 2 ? ConvexBody(fcl::Coned(radius, length)) : ConvexBody(fcl::Cylinderd(radius, length));
    const FlatPair pair{ConvexBody(fcl::Sphered(ball)), shape, Pose::Identity(), pose,
                        GaussianDisplacement::fromStandardDeviations({sigma, sigma, thin}, turn)};
    const double truth = uprightMass(0.5 * length, radius, top, ball, across, z, sigma, thin);
    INFO((k % 2 ? "cone " : "cylinder ") << radius << " " << length << " " << ball << " at "
                                         << across << ", " << z << ", " << sigma << " " << thin);
    checkTells(pair.mass(), truth, 1e-8, 1e-6);
    // By the boundary as well, which is wider the more deviations the bodies are long.
    const Bounds boundary =
        detail::curvedPairMass(pair.a, pair.pose_a, pair.b, pair.pose_b, pair.displacement, {})
            .mass;
    checkTells(boundary, truth, 1e-8, thin > 1e-4 ? 1e-6 : 1.0);
  }
}

TEST_CASE("a slanted side far larger than all deviations is a plane") {
  RandomBodies random(9023);
  for (int k = 0; k < 40; ++k) {
    const double sigma = random.logUniform(0.1, 1.0), thin = sigma * random.logUniform(1e-7, 1e-3);
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        {sigma, random.uniform(0.3, 1.0) * sigma, thin}, random.quaternion());
    // The side's normal is z of the box.
    const Eigen::Matrix3d rotation = random.rotation();
    const Vector3d normal = rotation.col(2);
    const double spread = displacement.standardDeviations()
                              .cwiseProduct(displacement.axes().transpose() * normal)
                              .norm();
    const double height = random.uniform(-3.0, 20.0);
    Pose pose = at(normal * (20.0 + height * spread));
    pose.linear() = rotation;
    const FlatPair pair{ConvexBody(fcl::Boxd(0.5, 0.4, 0.3)),
                        ConvexBody(fcl::Boxd(40.0, 40.0, 40.0)), Pose::Identity(), pose,
                        displacement};
    const double reach = Vector3d(0.25, 0.2, 0.15).dot(normal.cwiseAbs());
    const double truth = 0.5 * std::erfc((height - reach / spread) / std::sqrt(2.0));
    // What rounding does to places of 20 m.
    const double lost = 1e-13 / spread * (std::abs(height) + 1.0) + 1e-11;
    INFO(k << ": " << sigma << " " << thin << ", height " << height << ", spread " << spread);
    checkTells(pair.mass(), truth, lost, 1e-6 + 20.0 * lost);
  }
}

}  // namespace
