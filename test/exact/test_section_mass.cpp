// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Curved shapes that move in a plane or along a line: against C-obstacles in closed form, polytopes
// inside and around, other routes of the library, and the same pair given in other ways.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

#include "catch.h"
#include "convex/convex_set.h"
#include "exact/section_mass.h"
#include "fcl_prob/convex_pcd.h"
#include "plane_truth.h"
#include "random_bodies.h"
#include "shapes.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;
using Eigen::Vector3d;
using Pose = Eigen::Isometry3d;
using Shape = std::shared_ptr<fcl::CollisionGeometryd>;

/// Two shapes at the same angles, whose C-obstacle has a closed form in their own frame, about the
/// difference of their origins.
struct KnownSum {
  Shape a, b;
  Distance distance;
};

double beyondCone(const Vector3d& p, double radius, double half, double ball) {
  // In the half-plane through the axis: distance from a triangle.
  const Eigen::Vector2d x(p.head<2>().norm(), p.z());
  const Eigen::Vector2d apex(0.0, half), rim(radius, -half), foot(0.0, -half);
  const auto toSegment = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const double share = (x - from).dot(to - from) / (to - from).squaredNorm();
    return (x - from - std::clamp(share, 0.0, 1.0) * (to - from)).norm();
  };
  const Eigen::Vector2d out = Eigen::Vector2d(2.0 * half, radius).normalized();
  const double depth = std::max(out.dot(x - apex), -half - x.y());
  return (depth <= 0.0 ? depth : std::min(toSegment(apex, rim), toSegment(foot, rim))) - ball;
}

std::vector<KnownSum> knownSums(RandomBodies& random, double size) {
  const auto length = [&] { return size * random.uniform(0.2, 1.0); };
  std::vector<KnownSum> sums;
  const Vector3d radii(length(), length(), length());
  const double scale = random.uniform(0.3, 2.0);
  sums.push_back({std::make_shared<fcl::Ellipsoidd>(radii),
                  std::make_shared<fcl::Ellipsoidd>(Vector3d(scale * radii)),
                  [=](const Vector3d& p) {
                    return size * (p.cwiseQuotient((1.0 + scale) * radii).norm() - 1.0);
                  }});
  const double r = length(), s = length(), l = length(), m = length();
  sums.push_back({std::make_shared<fcl::Cylinderd>(r, l), std::make_shared<fcl::Cylinderd>(s, m),
                  [=](const Vector3d& p) {
                    return std::max(p.head<2>().norm() - (r + s), std::abs(p.z()) - 0.5 * (l + m));
                  }});
  const double half = 0.5 * l;
  sums.push_back({std::make_shared<fcl::Sphered>(s), std::make_shared<fcl::Coned>(r, l),
                  [=](const Vector3d& p) { return beyondCone(p, r, half, s); }});
  sums.push_back({std::make_shared<fcl::Capsuled>(r, l), std::make_shared<fcl::Sphered>(s),
                  [=](const Vector3d& p) {
                    const double z = std::max(0.0, std::abs(p.z()) - half);
                    return std::hypot(p.head<2>().norm(), z) - (r + s);
                  }});
  return sums;
}

/// Both at the same angles, the second one moved by up to a few deviations.
struct PlacedSum {
  PlacedSum(const KnownSum& sum, double size, int rank, RandomBodies& random)
      : a(*sum.a),
        b(*sum.b),
        pose_a(random.pose(0.1)),
        pose_b(pose_a),
        error(GaussianDisplacement::fromStandardDeviations(
            {random.uniform(0.5, 1.0), rank == 2 ? random.uniform(0.1, 0.5) : 0.0, 0.0},
            random.quaternion())) {
    pose_b.translation() += 0.4 * size * random.uniform(0.0, 1.0) * random.direction() +
                            random.uniform(0.0, 2.0) * error.axes().col(0);
    distance = [known = sum.distance, a_pose = pose_a, b_pose = pose_b](const Vector3d& moved) {
      return known(a_pose.linear().transpose() *
                   (a_pose.translation() + moved - b_pose.translation()));
    };
  }

  Bounds mass() const { return detail::sectionMass(a, pose_a, b, pose_b, error, {}); }

  ConvexBody a, b;
  Pose pose_a, pose_b;
  GaussianDisplacement error;
  Distance distance;
};

TEST_CASE("curved shapes that move along a line against where it meets a known C-obstacle") {
  RandomBodies random(501);
  for (int k = 0; k < 200; ++k) {
    const double size = random.logUniform(0.1, 10.0);
    for (const KnownSum& sum : knownSums(random, size)) {
      const PlacedSum placed(sum, size, 1, random);
      const Vector3d axis = placed.error.axes().col(0);
      const double sigma = placed.error.standardDeviations()[0];
      const auto [from, to] = whereNegative(
          [&](double t) { return placed.distance(t * axis + placed.error.mean()); }, 50.0);
      const double truth = massBetween(from / sigma, to / sigma);
      // How far ends may be off in the test's own search, next to what is between them.
      const double own = 1e-13 * (10.0 + size) / std::max(1e-6, to - from) * 1e2;
      const Bounds mass = placed.mass();
      INFO(mass.lower << " to " << mass.upper << ", truth " << truth << ", size " << size);
      CHECK(mass.lower <= truth * (1.0 + own) + 1e-15);
      CHECK(mass.upper >= truth * (1.0 - own) - 1e-15);
      CHECK(mass.width() <= std::max(1e-9 * mass.upper, 1e-280));
    }
  }
}

TEST_CASE("curved shapes that move in a plane against quadrature over known C-obstacles") {
  RandomBodies random(502);
  for (int k = 0; k < 4; ++k) {
    const double size = random.uniform(0.5, 1.5);
    for (const KnownSum& sum : knownSums(random, size)) {
      const PlacedSum placed(sum, size, 2, random);
      const double truth = massInPlane(placed.distance, placed.error, 8.0);
      const Bounds mass = placed.mass();
      INFO(mass.lower << " to " << mass.upper << ", truth " << truth);
      CHECK(mass.width() <= std::max(1e-6 * mass.upper, 1e-290));
      // The test's own quadrature has kinks to step over.
      CHECK(mass.lower <= truth * (1.0 + 3e-7) + 1e-14);
      CHECK(mass.upper >= truth * (1.0 - 3e-7) - 1e-14);
    }
  }
}

Shape randomShape(RandomBodies& random, double size) {
  const auto length = [&] { return size * random.uniform(0.2, 1.0); };
  switch (random.integer(0, 6)) {
    case 0:
      return std::make_shared<fcl::Ellipsoidd>(length(), length(), length());
    case 1:
      return std::make_shared<fcl::Cylinderd>(length(), length());
    case 2:
      return std::make_shared<fcl::Coned>(length(), length());
    case 3:
      return std::make_shared<fcl::Sphered>(length());
    case 4:
      return std::make_shared<fcl::Capsuled>(length(), length());
    case 5:
      return std::make_shared<fcl::Boxd>(length(), length(), length());
    default:
      return randomConvex(20, size, static_cast<unsigned>(random.integer(0, 100)));
  }
}

/// Random shapes, at least one of them curved, at about as many deviations as asked for.
struct RandomPair {
  RandomPair(RandomBodies& random, double size, int rank, double deviations)
      : shape_a(randomShape(random, size)),
        shape_b(randomShape(random, size)),
        a(*shape_a),
        b(*shape_b),
        error(GaussianDisplacement::fromStandardDeviations(
            {1.0, rank == 2 ? random.uniform(0.1, 1.0) : 0.0, 0.0}, random.quaternion())),
        pose_a(random.pose(0.1 * size)),
        pose_b(random.pose(0.1 * size)) {
    Vector3d way = error.axes().col(0);
    double deviation = 1.0;
    if (rank == 2) {
      const double angle = random.uniform(0.0, 2.0 * M_PI);
      way = std::cos(angle) * way + std::sin(angle) * error.axes().col(1);
      deviation = std::hypot(std::cos(angle), std::sin(angle) * error.standardDeviations()[1]);
    }
    const double reach = supportAlong(b, pose_b, -way) + supportAlong(a, pose_a, way);
    pose_b.translation() += (0.8 * reach + deviations * deviation) * way;
  }

  static double supportAlong(const ConvexBody& body, const Pose& pose, const Vector3d& way) {
    return (pose.linear() * body.supportPoint(pose.linear().transpose() * way)).dot(way);
  }

  bool isFlat() const { return a.isPolytope() && b.isPolytope(); }
  Bounds mass() const { return detail::sectionMass(a, pose_a, b, pose_b, error, {}); }

  Shape shape_a, shape_b;
  ConvexBody a, b;
  GaussianDisplacement error;
  Pose pose_a, pose_b;
};

TEST_CASE("sections of curved shapes are between those of polytopes, and tight") {
  RandomBodies random(503);
  const auto within = [](const ConvexBody& body) {
    return ConvexBody(body.set().innerMesh().vertices);
  };
  const auto around = [](const ConvexBody& body) {
    return ConvexBody(body.set().outerMesh().vertices);
  };
  int asked = 0, wide = 0;
  for (int k = 0; k < 300; ++k) {
    const int rank = 1 + k % 2;
    const double size = random.logUniform(0.01, 300.0);
    const RandomPair pair(random, size, rank, random.uniform(-1.0, 20.0));
    if (pair.isFlat()) continue;
    const Bounds mass = pair.mass();
    const double least =
        convexPairMass(within(pair.a), pair.pose_a, within(pair.b), pair.pose_b, pair.error).lower;
    const double most =
        convexPairMass(around(pair.a), pair.pose_a, around(pair.b), pair.pose_b, pair.error).upper;
    INFO("size " << size << ", rank " << rank << ": " << mass.lower << " to " << mass.upper
                 << ", polytopes " << least << " to " << most);
    CHECK(mass.upper >= least * (1.0 - 1e-12));
    CHECK(mass.lower <= most * (1.0 + 1e-12));
    const Bounds swapped =
        detail::sectionMass(pair.b, pair.pose_b, pair.a, pair.pose_a, pair.error.reversed(), {});
    CHECK(swapped.lower <= mass.upper);
    CHECK(mass.lower <= swapped.upper);
    ++asked;
    wide += mass.width() > std::max((rank == 1 ? 1e-9 : 1e-6) * mass.upper, 1e-280);
  }
  CHECK(asked > 200);
  CHECK(wide * 50 <= asked);
}

TEST_CASE("planes and lines that only touch a curved C-obstacle") {
  const fcl::Cylinderd cylinder(0.3, 1.0);
  const fcl::Ellipsoidd ellipsoid(0.2, 0.3, 0.4);
  for (const int rank : {1, 2}) {
    const auto error =
        GaussianDisplacement::fromStandardDeviations({0.5, rank == 2 ? 0.3 : 0.0, 0.0});
    for (const double beyond : {-1e-3, -1e-6, -1e-9, -1e-12, 0.0, 1e-14, 1e-12, 1e-9, 1e-3}) {
      Pose pose = Pose::Identity();
      pose.translation().z() = 0.5 + 0.4 + beyond;
      const Bounds mass = detail::sectionMass(ConvexBody(cylinder), Pose::Identity(),
                                              ConvexBody(ellipsoid), pose, error, {});
      INFO("rank " << rank << ", " << beyond << " beyond: " << mass.lower << " to " << mass.upper);
      // At height h below its top the ellipsoid is as wide as sqrt(1 - (1 - h/c)²).
      const double h = std::max(0.0, -beyond) / 0.4;
      const double share = std::sqrt(h * (2.0 - h));
      const double within = 0.3 + 0.2 * share, around = 0.3 + 0.3 * share;
      const double less = rank == 1 ? massBetween(-within / 0.5, within / 0.5)
                                    : massBetween(-within / 0.8, within / 0.8) *
                                          massBetween(-within / 0.5, within / 0.5);
      if (beyond <= 0.0) CHECK(mass.upper >= less * 0.7 * (rank == 1 ? 1.0 : 0.5));
      const double most = massBetween(-around / 0.5, around / 0.5);
      if (beyond < 0.0) CHECK(mass.lower <= most);
      if (beyond > 1e-13) CHECK(mass.upper == 0.0);
      if (beyond <= -1e-6) CHECK(mass.width() <= 1e-6 * mass.upper);
    }
  }
}

}  // namespace
