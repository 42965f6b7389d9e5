// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Enlargement by a confidence ellipsoid, and the sphere methods over trees.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <boost/math/distributions/chi_squared.hpp>

#include "catch.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/prior_methods.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;

double radiusOf(double confidence) {
  return std::sqrt(
      boost::math::quantile(boost::math::chi_squared_distribution<double>(3.0), confidence));
}

GaussianDisplacement isotropic(double sigma) {
  return GaussianDisplacement::fromStandardDeviations(Eigen::Vector3d::Constant(sigma));
}

double meshDistance(const fcl::BVHModel<fcl::OBBRSSd>& a, const Eigen::Isometry3d& pose_a,
                    const fcl::BVHModel<fcl::OBBRSSd>& b, const Eigen::Isometry3d& pose_b) {
  fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  return fcl::distance(&a, pose_a, &b, pose_b, request, result);
}

TEST_CASE("two enlarged spheres collide when their distance is below both radii and k sigma") {
  RandomBodies random(31);
  for (int i = 0; i < 300; ++i) {
    const double radius_a = random.logUniform(1e-3, 1.0);
    const double radius_b = random.logUniform(1e-3, 1.0);
    const double sigma = random.logUniform(1e-3, 1.0);
    const double confidence = random.uniform(0.05, 0.999);
    const double limit = radius_a + radius_b + radiusOf(confidence) * sigma;
    const Eigen::Vector3d direction = random.direction();
    const auto collides = [&](double distance) {
      return enlargedCollision(fcl::Sphered(radius_a), random.pose(0.0), fcl::Sphered(radius_b),
                               at(distance * direction), isotropic(sigma), confidence)
          .collides;
    };
    CAPTURE(radius_a, radius_b, sigma, confidence);
    CHECK(collides(limit * (1.0 - 1e-6)));
    CHECK(!collides(limit * (1.0 + 1e-6)));
  }
}

TEST_CASE("an enlarged sphere and a box collide within k sigma of the box, along each axis") {
  // Σ with axes along the box's: the flip is where the ellipsoid swept by the sphere meets a face.
  const Eigen::Vector3d deviations(0.05, 0.1, 0.2);
  const auto displacement = GaussianDisplacement::fromStandardDeviations(deviations);
  const fcl::Sphered sphere(0.3);
  const fcl::Boxd box(1.0, 2.0, 3.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double limit = 0.5 * box.side[axis] + 0.3 + radiusOf(0.95) * deviations[axis];
    const auto result = [&](double distance) {
      return enlargedCollision(sphere, at(distance * Eigen::Vector3d::Unit(axis)), box,
                               at({0, 0, 0}), displacement);
    };
    CHECK(result(limit - 1e-4).collides);
    CHECK(result(limit - 1e-4).upper == 1.0);
    CHECK(!result(limit + 1e-4).collides);
    CHECK(result(limit + 1e-4).upper == Approx(0.05));
  }
}

TEST_CASE("enlarged meshes under isotropic displacements collide when fcl::distance says so") {
  RandomBodies random(32);
  const auto a = makeModel<fcl::OBBRSSd>(bumpyMesh(1.0, 8, 12, 1));
  const auto b = makeModel<fcl::OBBRSSd>(bumpyMesh(0.8, 8, 12, 2));
  const auto slow_a = makeModel<fcl::KDOPd<24>>(bumpyMesh(1.0, 8, 12, 1));
  int colliding = 0;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Isometry3d pose_a = random.pose(0.1);
    Eigen::Isometry3d pose_b = random.pose(0.0);
    pose_b.translation() = random.uniform(1.9, 3.0) * random.direction();
    const double distance = meshDistance(*a, pose_a, *b, pose_b);
    if (distance < 1e-3) continue;
    const double flip = distance / radiusOf(0.95);
    CAPTURE(i, distance);
    const double sigma = flip * (i % 2 == 0 ? 1.0 + 1e-6 : 1.0 - 1e-6);
    const EnlargedCollision result = enlargedCollision(*a, pose_a, *b, pose_b, isotropic(sigma));
    CHECK(result.collides == (i % 2 == 0));
    CHECK(result.upper == Approx(result.collides ? 1.0 : 0.05));
    CHECK(result.pairs_tested > 0);
    colliding += result.collides;
    if (i < 4) {
      CHECK(enlargedCollision(*slow_a, pose_a, *b, pose_b, isotropic(sigma)).collides ==
            result.collides);
    }
  }
  CHECK(colliding > 15);
  CHECK(colliding < 45);
}

TEST_CASE("enlargement that finds nothing bounds P, whatever the displacement") {
  RandomBodies random(33);
  int free = 0;
  for (int i = 0; i < 200; ++i) {
    const fcl::Boxd box(random.uniform(0.1, 1.0), random.uniform(0.1, 1.0),
                        random.uniform(0.1, 1.0));
    const fcl::Boxd other(0.3, 0.2, 0.1);
    const Eigen::Isometry3d pose_a = random.pose(0.1);
    const Eigen::Isometry3d pose_b = random.pose(1.6);
    const auto displacement = GaussianDisplacement::fromStandardDeviations(
        {random.logUniform(0.01, 0.3), random.logUniform(0.01, 0.3), random.logUniform(0.01, 0.3)},
        random.quaternion(), 0.1 * random.normalVector());
    const double confidence = random.uniform(0.3, 0.99);
    const EnlargedCollision result =
        enlargedCollision(other, pose_a, box, pose_b, displacement, confidence);
    const Bounds mass =
        convexPairMass(ConvexBody(other), pose_a, ConvexBody(box), pose_b, displacement);
    CAPTURE(i, confidence, mass.lower, mass.upper);
    CHECK(result.upper >= mass.lower);
    free += !result.collides;
  }
  CHECK(free > 40);
  CHECK(free < 180);
}

TEST_CASE("enlargement refuses what it cannot do") {
  const fcl::Sphered sphere(1.0);
  const fcl::Halfspaced ground(Eigen::Vector3d::UnitZ(), 0.0);
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  CHECK_THROWS_AS(enlargedCollision(sphere, pose, ground, pose, isotropic(1.0)),
                  UnsupportedGeometry);
  CHECK_THROWS_AS(enlargedCollision(sphere, pose, sphere, pose, isotropic(1.0), 1.0),
                  InvalidRequest);
  CHECK_THROWS_AS(enlargedCollision(sphere, pose, sphere, pose, GaussianDisplacement()),
                  InvalidDistribution);
}

TEST_CASE("Park's bound over trees of spheres is above P") {
  const TriangleMesh mesh_a = bumpyMesh(1.0, 8, 12, 1);
  const TriangleMesh mesh_b = bumpyMesh(0.8, 8, 12, 2);
  const auto a = makeModel<SphereBv>(mesh_a);
  const auto b = makeModel<SphereBv>(mesh_b);
  const auto displacement = GaussianDisplacement::fromStandardDeviations(
      {0.05, 0.1, 0.2}, Eigen::Quaterniond(0.5, 0.1, -0.7, 0.5).normalized());
  const Eigen::Isometry3d pose_a = at({0, 0, 0});
  const Eigen::Isometry3d pose_b = at({2.1, 0.3, 0.1});
  GeneralPcdRequest request;
  request.confidence = 0.999;
  const GeneralPcdResult park = parkSum(*a, pose_a, *b, pose_b, displacement, request);
  CHECK(park.pairs_bounded > 100);
  CHECK(park.root ==
        std::min(1.0, parkBound({a->getBV(0).bv.center(), a->getBV(0).bv.radius()}, pose_a,
                                {b->getBV(0).bv.center(), b->getBV(0).bv.radius()}, pose_b,
                                displacement)));
  const auto hit_a = makeModel<fcl::OBBRSSd>(mesh_a);
  const auto hit_b = makeModel<fcl::OBBRSSd>(mesh_b);
  RandomBodies random(34);
  int hits = 0;
  const int samples = 2000;
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector3d scaled =
        displacement.standardDeviations().cwiseProduct(random.normalVector());
    Eigen::Isometry3d moved = pose_a;
    moved.translation() += displacement.axes() * scaled;
    fcl::CollisionRequestd collision_request;
    fcl::CollisionResultd result;
    hits += fcl::collide(hit_a.get(), moved, hit_b.get(), pose_b, collision_request, result) > 0;
  }
  const double p = static_cast<double>(hits) / samples;
  CHECK(p > 0.002);
  CHECK(park.upper >= p - 4.0 * std::sqrt(p / samples));
  request.variant = GeneralPcdVariant::minimum;
  const GeneralPcdResult minimum = parkSum(*a, pose_a, *b, pose_b, displacement, request);
  CHECK(minimum.upper >= p - 4.0 * std::sqrt(p / samples));
  CHECK(minimum.upper <= std::min(1.0, park.raw_sum) * (1 + 1e-12));

  // The same pairs, each by the density at the middle instead of the largest one.
  const double du_toit = duToitBurdickSum(*a, pose_a, *b, pose_b, displacement, request);
  CHECK(du_toit > 0.1 * p);
  CHECK(du_toit < park.raw_sum);
  request.max_pairs = 1;
  CHECK(duToitBurdickSum(*a, pose_a, *b, pose_b, displacement, request) < 1e-9 * du_toit);
  request.confidence = 2.0;
  CHECK_THROWS_AS(duToitBurdickSum(*a, pose_a, *b, pose_b, displacement, request), InvalidRequest);
}

}  // namespace
