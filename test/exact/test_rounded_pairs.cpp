// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Spheres and capsules beside each other, boxes, triangles and convex polytopes: against
// fcl::collide at random displacements, and the same solid given in different ways.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <memory>

#include "catch.h"
#include "fcl_prob/convex_pcd.h"
#include "shapes.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;
using Eigen::Vector3d;

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

struct GeometryPair {
  std::string name;
  Geometry a, b;
  Geometry known_b = b;  ///< what FCL knows instead of a TriangleP
};

/// The six of which the C-obstacle is a polytope swept by a ball; about `size` metres wide.
std::vector<GeometryPair> roundedPairs(double size, unsigned seed) {
  const auto sphere = std::make_shared<fcl::Sphered>(0.3 * size);
  const auto capsule = std::make_shared<fcl::Capsuled>(0.2 * size, 0.7 * size);
  const auto other = std::make_shared<fcl::Capsuled>(0.1 * size, 1.1 * size);
  const auto box = std::make_shared<fcl::Boxd>(0.9 * size, 0.5 * size, 0.3 * size);
  const Vector3d p = size * Vector3d(0.4, -0.2, 0.1), q = size * Vector3d(-0.3, 0.5, 0.0),
                 r = size * Vector3d(0.0, 0.0, 0.4);
  const auto triangle = std::make_shared<fcl::TrianglePd>(p, q, r);
  const auto mesh = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  mesh->beginModel();
  mesh->addTriangle(p, q, r);
  mesh->endModel();
  return {{"sphere and capsule", sphere, capsule},
          {"sphere and box", sphere, box},
          {"capsule and capsule", capsule, other},
          {"capsule and box", capsule, box},
          {"sphere and triangle", sphere, triangle, mesh},
          {"sphere and hull", sphere, randomConvex(50, 0.5 * size, seed)}};
}

struct Placed {
  Eigen::Isometry3d a = Eigen::Isometry3d::Identity(), b = Eigen::Isometry3d::Identity();
};

Bounds massOf(const GeometryPair& pair, const Placed& at, const GaussianDisplacement& error) {
  return convexPairMass(ConvexBody(*pair.a), at.a, ConvexBody(*pair.b), at.b, error);
}

bool overlap(const Bounds& a, const Bounds& b) { return a.lower <= b.upper && b.lower <= a.upper; }

/// Moves B towards A, from far away, until about as much is between them.
void placeApart(const GeometryPair& pair, double distance, const Vector3d& away, Placed& at) {
  const Vector3d direction = away.normalized();
  at.b.translation() = away + distance * direction;
  for (int k = 0; k < 30; ++k) {
    fcl::DistanceResultd between;
    fcl::distance(pair.a.get(), at.a, pair.known_b.get(), at.b, fcl::DistanceRequestd(), between);
    at.b.translation() -= std::max(0.0, between.min_distance - distance) * direction;
  }
}

TEST_CASE("rounded pairs against fcl::collide at random displacements") {
  RandomBodies random(171);
  for (int k = 0; k < 2; ++k) {
    for (const GeometryPair& pair : roundedPairs(1.0, 5)) {
      const GaussianDisplacement error = randomDisplacement(random, 0.1, 1.0);
      Placed at;
      at.a = random.pose(0.5);
      at.b = random.pose(0.8);
      const Bounds mass = massOf(pair, at, error);
      constexpr int kSamples = 20'000;
      int hits = 0;
      for (int n = 0; n < kSamples; ++n) {
        const Vector3d along = error.standardDeviations().cwiseProduct(random.normalVector());
        Eigen::Isometry3d moved = at.a;
        moved.translation() += error.axes() * along;
        fcl::CollisionResultd contact;
        fcl::collide(pair.a.get(), moved, pair.known_b.get(), at.b, fcl::CollisionRequestd(),
                     contact);
        hits += contact.isCollision();
      }
      const double p = mass.middle(), share = static_cast<double>(hits) / kSamples;
      INFO(pair.name << ": " << mass.lower << " to " << mass.upper << ", samples " << share);
      CHECK(mass.width() <= 1e-9 * mass.upper);
      CHECK(std::abs(share - p) <= 5.0 * std::sqrt(p * (1.0 - p) / kSamples + 1e-9));
    }
  }
}

TEST_CASE("rounded pairs of all sizes and distances are certified to nine digits") {
  RandomBodies random(172);
  for (const double size : {1e-3, 0.03, 1.0, 30.0, 300.0}) {
    for (const double distance : {0.0, 2.0, 10.0, 30.0}) {
      for (const GeometryPair& pair : roundedPairs(size, 7)) {
        const Vector3d deviations(1.0, random.uniform(0.3, 1.0), random.uniform(0.3, 1.0));
        const auto error =
            GaussianDisplacement::fromStandardDeviations(deviations, random.quaternion());
        Placed at;
        at.a.linear() = random.rotation();
        at.b.linear() = random.rotation();
        const Vector3d direction = random.direction();
        at.b.translation() = 0.1 * size * direction;
        if (distance > 0.0)
          placeApart(pair, distance * deviations.minCoeff(), 3.0 * size * direction, at);
        const Bounds mass = massOf(pair, at, error);
        INFO(pair.name << ", size " << size << ", distance " << distance << ": " << mass.lower
                       << " to " << mass.upper);
        CHECK(mass.lower > 0.0);
        CHECK(mass.width() <= 1e-9 * mass.upper);
      }
    }
  }
}

TEST_CASE("rounded pairs given in other ways have the same probability") {
  RandomBodies random(173);
  for (int k = 0; k < 10; ++k) {
    const GaussianDisplacement error = randomDisplacement(random, 0.05, 1.0);
    Placed at;
    at.a = random.pose(1.0);
    at.b = random.pose(1.0);
    const fcl::Capsuled capsule(0.2, 0.7);
    const Vector3d half(0.4, 0.2, 0.3);
    std::vector<Vector3d> corners;
    for (int i = 0; i < 8; ++i) {
      corners.push_back(
          half.cwiseProduct(Vector3d((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1)));
    }
    const ConvexBody rod(capsule), box(fcl::Boxd(2.0 * half)), hull(corners);
    const Bounds mass = convexPairMass(rod, at.a, box, at.b, error);
    CHECK(mass.width() <= 1e-9 * mass.upper);
    CHECK(overlap(mass, convexPairMass(rod, at.a, hull, at.b, error)));
    CHECK(overlap(mass, convexPairMass(hull, at.b, rod, at.a, error.reversed())));
    // Edges and axes that are parallel to the last bit, or nearly.
    for (const double turn : {0.0, 1e-15, 1e-12}) {
      Eigen::Isometry3d along = at.b;
      along.linear() = at.b.linear() * Eigen::AngleAxisd(turn, Vector3d(1, 2, 3).normalized());
      const Bounds parallel = convexPairMass(rod, along, box, at.b, error);
      INFO(turn << ": " << parallel.lower << " to " << parallel.upper);
      CHECK(parallel.width() <= 1e-9 * parallel.upper);
      CHECK(overlap(parallel, convexPairMass(rod, along, hull, at.b, error)));
    }
  }
}

TEST_CASE("rounded pairs whose cores are as thin as rounding are no worse than certified") {
  const auto error = GaussianDisplacement::fromStandardDeviations({0.5, 0.4, 0.3});
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity(), at = turned, still = turned;
  turned.linear() = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  at.translation() = Vector3d(0.6, 0.3, 0.2);
  const auto near = [](const Bounds& mass, const Bounds& truth) {
    INFO(mass.lower << " to " << mass.upper << ", near " << truth.lower);
    CHECK(mass.lower <= mass.upper);
    CHECK(mass.lower <= truth.upper * (1.0 + 1e-9));
    CHECK(mass.upper >= truth.lower * (1.0 - 1e-9));
  };
  const ConvexBody rod(fcl::Capsuled(0.2, 1.0)), long_rod(fcl::Capsuled(0.3, 1.0));
  const ConvexBody ball(fcl::Sphered(0.3));
  const Bounds of_ball = convexPairMass(ball, turned, rod, at, error);
  CHECK(of_ball.lower == Approx(0.21304).epsilon(1e-4));
  for (const double length : {1e-16, 1e-15, 3e-14, 9e-14, 2e-13, 1e-12, 1e-11}) {
    near(convexPairMass(ConvexBody(fcl::Capsuled(0.3, length)), turned, rod, at, error), of_ball);
  }
  const Bounds parallel = convexPairMass(long_rod, still, rod, at, error);
  for (const double angle : {1e-16, 2e-14, 1e-13, 3e-13, 1e-11}) {
    Eigen::Isometry3d hardly = still;
    hardly.linear() = Eigen::AngleAxisd(angle, Vector3d(1, 2, 0).normalized()).toRotationMatrix();
    near(convexPairMass(long_rod, hardly, rod, at, error), parallel);
  }
  const Bounds needle =
      convexPairMass(ball, still, ConvexBody(fcl::Boxd(1, 1e-9, 1e-9)), at, error);
  for (const double thick : {5e-15, 5e-14, 1e-13, 1e-12, 1e-11}) {
    for (const double flat : {0.6, 1.0}) {
      near(convexPairMass(ball, still, ConvexBody(fcl::Boxd(1, thick, flat * thick)), at, error),
           {needle.lower * (1 - 1e-7), needle.upper});
    }
  }
}

TEST_CASE("thin boxes beside spheres have the probability of a segment") {
  RandomBodies random(175);
  for (int k = 0; k < 300; ++k) {
    const double radius = random.logUniform(0.03, 1.0), thick = random.logUniform(1e-15, 1e-11);
    const GaussianDisplacement error = randomDisplacement(random, 0.03, 1.0);
    Placed at;
    at.a = random.pose(1.0);
    at.b = random.pose(1.0);
    const ConvexBody ball{fcl::Sphered(radius)}, needle(fcl::Boxd(thick, 0.6 * thick, 1.0));
    const Bounds mass = convexPairMass(ball, at.a, needle, at.b, error);
    const ConvexBody segment(std::vector<Vector3d>{{0, 0, -0.5}, {0, 0, 0.5}});
    const Bounds truth = convexPairMass(ball, at.a, segment, at.b, error);
    INFO(k << ": " << mass.lower << " to " << mass.upper << ", segment " << truth.lower << " to "
           << truth.upper);
    CHECK(mass.lower <= truth.upper * (1.0 + 1e-8) + 1e-300);
    CHECK(mass.upper >= truth.lower * (1.0 - 1e-8));
  }
}

TEST_CASE("rounded pairs under low ranks have an interval") {
  RandomBodies random(174);
  for (const GeometryPair& pair : roundedPairs(1.0, 9)) {
    for (const int rank : {1, 2}) {
      const Vector3d deviations(1.0, rank == 2 ? 0.5 : 0.0, 0.0);
      const auto error =
          GaussianDisplacement::fromStandardDeviations(deviations, random.quaternion());
      Placed at;
      at.b.translation() = 0.2 * random.direction();
      const Bounds mass = massOf(pair, at, error);
      CHECK(mass.lower >= 0.0);
      CHECK(mass.upper > mass.lower);
    }
  }
}

}  // namespace
