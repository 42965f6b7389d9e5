// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include "catch.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/prior_methods.h"
#include "fcl_prob/whitening.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;

struct SpherePair {
  BoundingSphere a;
  BoundingSphere b;
  Eigen::Isometry3d pose_a;
  Eigen::Isometry3d pose_b;
  GaussianDisplacement displacement;

  double radius() const { return a.radius + b.radius; }
  Eigen::Vector3d centre() const {
    return pose_b * b.centre - pose_a * a.centre - displacement.mean();
  }
  double park() const { return parkBound(a, pose_a, b, pose_b, displacement); }
  double duToit() const { return duToitBurdick(a, pose_a, b, pose_b, displacement); }

  /// From outside of and from inside the C-obstacle.
  Bounds mass() const {
    const auto moved = [](const Eigen::Isometry3d& pose, const Eigen::Vector3d& centre) {
      Eigen::Isometry3d result = pose;
      result.translation() = pose * centre;
      return result;
    };
    return convexPairMass(ConvexBody(fcl::Sphered(a.radius)), moved(pose_a, a.centre),
                          ConvexBody(fcl::Sphered(b.radius)), moved(pose_b, b.centre),
                          displacement);
  }
};

/// Centres up to `reach` standard deviations away, beyond the radii.
SpherePair randomPair(RandomBodies& random, double least_radius, double most_radius, double reach) {
  const Eigen::Vector3d deviations(random.logUniform(0.01, 0.1), random.logUniform(0.01, 0.1),
                                   random.logUniform(0.01, 0.1));
  SpherePair pair{{0.1 * random.normalVector(), random.logUniform(least_radius, most_radius)},
                  {0.1 * random.normalVector(), random.logUniform(least_radius, most_radius)},
                  random.pose(1.0),
                  random.pose(1.0),
                  GaussianDisplacement::fromStandardDeviations(deviations, random.quaternion(),
                                                               0.01 * random.normalVector())};
  const Eigen::Vector3d y = reach * random.uniform(0.0, 1.0) * random.direction();
  const Eigen::Vector3d scaled = pair.displacement.standardDeviations().cwiseProduct(y);
  const Eigen::Vector3d wanted = pair.displacement.axes() * scaled + pair.radius() * y.normalized();
  pair.pose_b.translation() += wanted - pair.centre();
  return pair;
}

TEST_CASE("Park's bound is above P and no higher than the densest point makes it") {
  RandomBodies random(21);
  int tight = 0, above_one = 0, tail = 0;
  for (int i = 0; i < 100; ++i) {
    const SpherePair pair = randomPair(random, 0.002, 0.2, 6.0);
    const double park = pair.park();
    const Bounds mass = pair.mass();
    CAPTURE(i, park, mass.lower, mass.upper);
    REQUIRE(park >= mass.lower);
    tight += park < 2.0 * mass.upper;
    above_one += park > 1.0;
    tail += park < 1e-4;

    const Whitening whitening(pair.displacement.withMean(Eigen::Vector3d::Zero()));
    double nearest =
        pair.centre().norm() <= pair.radius() ? 0.0 : std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4000; ++k) {
      const Eigen::Vector3d point = pair.centre() + pair.radius() * random.direction();
      nearest = std::min(nearest, whitening.apply(point).squaredNorm());
    }
    const double density =
        std::exp(-0.5 * nearest) * whitening.matrix().determinant() * std::pow(2.0 * M_PI, -1.5);
    const double sampled = std::abs(density) * 4.0 / 3.0 * M_PI * std::pow(pair.radius(), 3);
    REQUIRE(park >= sampled * (1.0 - 1e-10));
    REQUIRE(park <= 1.5 * sampled + 1e-290);  // 4,000 points do not hit the densest one
  }
  CHECK(tight > 3);
  CHECK(above_one > 10);
  CHECK(tail > 10);
}

TEST_CASE("Park's bound for isotropic displacements is the density at the nearest point") {
  RandomBodies random(22);
  for (int i = 0; i < 500; ++i) {
    const double sigma = random.logUniform(1e-3, 10.0);
    const double radius = sigma * random.logUniform(1e-6, 10.0);
    const double distance = sigma * random.uniform(0.0, 30.0);
    const GaussianDisplacement displacement =
        GaussianDisplacement::fromStandardDeviations(Eigen::Vector3d::Constant(sigma));
    Eigen::Isometry3d pose_b = Eigen::Isometry3d::Identity();
    pose_b.translation() = distance * random.direction();
    const double park =
        parkBound({Eigen::Vector3d::Zero(), 0.25 * radius}, Eigen::Isometry3d::Identity(),
                  {Eigen::Vector3d::Zero(), 0.75 * radius}, pose_b, displacement);
    const double gap = std::max(0.0, distance - radius) / sigma;
    const double expected = std::exp(-0.5 * gap * gap) * std::pow(2.0 * M_PI, -1.5) * 4.0 / 3.0 *
                            M_PI * std::pow(radius / sigma, 3);
    CAPTURE(sigma, radius, distance, park, expected);
    REQUIRE(park >= normalBallMass(distance / sigma, radius / sigma).lower);
    REQUIRE(park >= expected * (1.0 - 1e-9));
    REQUIRE(park <= expected * (1.0 + 1e-5) + 2e-300);
  }
}

TEST_CASE("Du Toit and Burdick's approximation is seen on both sides of P") {
  RandomBodies random(23);
  int below = 0, above = 0, near = 0;
  for (int i = 0; i < 100; ++i) {
    const SpherePair pair = randomPair(random, 0.002, 0.05, 4.0);
    const Bounds mass = pair.mass();
    const double value = pair.duToit();
    below += value < mass.lower;
    above += value > mass.upper;
    CHECK(value <= pair.park());
    if (i % 10 != 0) continue;
    // In the limit of small balls it is right.
    SpherePair small = pair;
    const double shrink = 1e-5 / pair.radius();
    small.a.radius *= shrink;
    small.b.radius *= shrink;
    const Bounds small_mass = small.mass();
    if (small_mass.lower < 1e-250) continue;
    CAPTURE(i, small_mass.lower, small.duToit(), small.park());
    CHECK(small.duToit() >= small_mass.lower * (1.0 - 0.02));
    CHECK(small.duToit() <= small_mass.upper * (1.0 + 0.02));
    CHECK(small.park() >= small_mass.lower);
    ++near;
  }
  CHECK(below > 10);
  CHECK(above > 10);
  CHECK(near > 7);
}

TEST_CASE("spheres of no size and extreme displacements keep Park's bound") {
  const BoundingSphere point{};
  const BoundingSphere ball{Eigen::Vector3d::Zero(), 1.0};
  const Eigen::Isometry3d here = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d there = here;
  there.translation() = Eigen::Vector3d(5.0, 0.0, 0.0);
  const auto sigma = [](double x, double y, double z) {
    return GaussianDisplacement::fromStandardDeviations({x, y, z});
  };
  CHECK(parkBound(point, here, point, here, sigma(1, 1, 1)) == 0.0);
  CHECK(parkBound(ball, here, ball, there, sigma(1e-3, 1e-3, 1e-3)) >= 0.0);
  CHECK(parkBound(ball, here, ball, there, sigma(1e-3, 1e-3, 1e-3)) < 1e-290);
  // Nearly a line: P is that of an interval, and the bound is useless but a bound.
  const double line = normalIntervalMass(3.0, 7.0);
  CHECK(parkBound(ball, here, ball, there, sigma(1.0, 1e-9, 1e-9)) >= line);
  CHECK(parkBound(ball, here, ball, here, sigma(1e-200, 1e-200, 1e-200)) >= 1.0);
  CHECK_THROWS_AS(parkBound(ball, here, ball, there, sigma(1, 1, 0)), InvalidDistribution);
  CHECK_THROWS_AS(duToitBurdick(ball, here, ball, there, sigma(1, 0, 0)), InvalidDistribution);
  CHECK_THROWS_AS(duToitBurdick({here.translation(), -1.0}, here, ball, there, sigma(1, 1, 1)),
                  InvalidGeometry);
}

TEST_CASE("bounding spheres hold their shapes and are not much too large") {
  const auto radius = [](const fcl::CollisionGeometryd& shape) {
    return boundingSphere(shape).radius;
  };
  CHECK(radius(fcl::Sphered(0.5)) == Approx(0.5).epsilon(1e-12));
  CHECK(radius(fcl::Capsuled(0.5, 2.0)) == Approx(1.5).epsilon(1e-12));
  CHECK(radius(fcl::Cylinderd(0.5, 2.0)) == Approx(std::hypot(0.5, 1.0)).epsilon(1e-12));
  CHECK(radius(fcl::Ellipsoidd(0.5, 1.0, 2.0)) == Approx(2.0).epsilon(1e-12));
  CHECK(radius(fcl::Boxd(2.0, 2.0, 1.0)) == Approx(1.5).epsilon(0.02));
  CHECK(radius(fcl::Boxd(2.0, 2.0, 1.0)) >= 1.5);
  const double cone = radius(fcl::Coned(0.5, 2.0));
  CHECK(cone >= 1.0625);  // the sphere through the apex and the base's rim
  CHECK(cone <= 1.2);
  CHECK_THROWS_AS(boundingSphere(fcl::Halfspaced(Eigen::Vector3d::UnitX(), 0.0)),
                  UnsupportedGeometry);

  const TriangleMesh mesh = bumpyMesh(1.0, 8, 12, 3);
  const BoundingSphere sphere = boundingSphere(*makeModel<fcl::OBBRSSd>(mesh));
  double farthest = 0.0;
  for (const auto& vertex : mesh.vertices) {
    farthest = std::max(farthest, (vertex - sphere.centre).norm());
  }
  CHECK(sphere.radius >= farthest);
  CHECK(sphere.radius <= 1.001 * farthest);
}

}  // namespace
