// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Spheres and capsules beside each other and what is flat, moving in a plane: against quadrature
// over lines, polytopes inside and around, and the same pair given in other ways.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include "catch.h"
#include "fcl_prob/convex_pcd.h"
#include "plane_truth.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;
using Eigen::Vector3d;
using Pose = Eigen::Isometry3d;

Bounds roundedMass(const ConvexBody& a, const Pose& pose_a, const ConvexBody& b, const Pose& pose_b,
                   const GaussianDisplacement& error) {
  return convexPairMass(a, pose_a, b, pose_b, error);
}

double distanceToSegment(const Vector3d& p, const Vector3d& end) {
  const double share = std::clamp(p.dot(end) / end.squaredNorm(), -1.0, 1.0);
  return (p - share * end).norm();
}

double distanceToBox(const Vector3d& p, const Vector3d& half) {
  return (p.cwiseAbs() - half).cwiseMax(0.0).norm();
}

TEST_CASE("capsules and boxes beside spheres in a plane against quadrature over lines") {
  RandomBodies random(401);
  for (int k = 0; k < 16; ++k) {
    const double ball = random.uniform(0.1, 0.8);
    const Vector3d half(random.uniform(0.1, 0.8), random.uniform(0.1, 0.8),
                        random.uniform(0.1, 0.8));
    const bool is_box = k % 2 == 0;
    const fcl::Sphered sphere(ball);
    const fcl::Boxd box(2.0 * half);
    const fcl::Capsuled capsule(half.x(), 2.0 * half.z());
    const auto error = GaussianDisplacement::fromStandardDeviations(
        {random.uniform(0.5, 1.0), random.uniform(0.1, 0.5), 0.0}, random.quaternion());
    const Pose pose_a = random.pose(0.1);
    Pose pose_b = random.pose(0.4);
    // Some are aside of the mean, within the plane.
    pose_b.translation() += random.uniform(0.0, 2.0) * error.axes().col(k % 2);
    const double radius = is_box ? ball : ball + half.x();
    const Distance distance = [&](const Vector3d& moved) {
      const Vector3d p =
          pose_b.linear().transpose() * (pose_a.translation() + moved - pose_b.translation());
      return (is_box ? distanceToBox(p, half)
                     : distanceToSegment(p, half.z() * Vector3d::UnitZ())) -
             radius;
    };
    const double truth = massInPlane(distance, error, 8.0);
    const fcl::CollisionGeometryd& other =
        is_box ? static_cast<const fcl::CollisionGeometryd&>(box) : capsule;
    const Bounds mass = roundedMass(ConvexBody(sphere), pose_a, ConvexBody(other), pose_b, error);
    INFO((is_box ? "box " : "capsule ")
         << half.transpose() << ", ball " << ball << ": " << mass.lower << " to " << mass.upper
         << ", truth " << truth);
    CHECK(mass.width() <= std::max(2.5e-7 * mass.upper, 1e-290));
    CHECK(mass.lower <= truth * (1.0 + 3e-8) + 1e-14);
    CHECK(mass.upper >= truth * (1.0 - 3e-8) - 1e-14);
  }
}

struct RoundPair {
  ConvexBody a, b;
  ConvexBody within, around;  ///< polytopes for A
};

/// Points on a sphere and, by the cosine of the widest angle between them, around it.
std::vector<Vector3d> ballPoints(double radius, double scale) {
  std::vector<Vector3d> points;
  constexpr int kRings = 14;
  for (int i = 0; i <= kRings; ++i) {
    const double polar = M_PI * i / kRings;
    const int count = i == 0 || i == kRings ? 1 : 2 * kRings;
    for (int k = 0; k < count; ++k) {
      const double around = 2.0 * M_PI * k / count;
      points.push_back(scale * radius *
                       Vector3d(std::sin(polar) * std::cos(around),
                                std::sin(polar) * std::sin(around), std::cos(polar)));
    }
  }
  return points;
}

std::vector<Vector3d> capsulePoints(double radius, double length, double scale) {
  std::vector<Vector3d> points;
  for (const Vector3d& p : ballPoints(radius, scale)) {
    for (const double end : {-0.5, 0.5}) points.push_back(p + end * length * Vector3d::UnitZ());
  }
  return points;
}

/// No less than one over the cosine of half the diagonal between neighbours.
constexpr double kAround = 1.0 / 0.97;

std::vector<RoundPair> roundPairs(RandomBodies& random, double size) {
  const auto length = [&] { return size * random.uniform(0.2, 1.0); };
  const double r = length(), s = length(), l = length();
  const auto ball = [&](const ConvexBody& b) {
    return RoundPair{ConvexBody(fcl::Sphered(r)), b, ConvexBody(ballPoints(r, 1.0)),
                     ConvexBody(ballPoints(r, kAround))};
  };
  const auto capsule = [&](const ConvexBody& b) {
    return RoundPair{ConvexBody(fcl::Capsuled(s, l)), b, ConvexBody(capsulePoints(s, l, 1.0)),
                     ConvexBody(capsulePoints(s, l, kAround))};
  };
  const ConvexBody box(fcl::Boxd(length(), length(), length()));
  const ConvexBody triangle(fcl::TrianglePd(
      size * random.normalVector(), size * random.normalVector(), size * random.normalVector()));
  const ConvexBody hull(random.onSphere(30, 0.7 * size));
  const Vector3d axes(length(), length(), length());
  const auto scaled = [&](double scale) {
    std::vector<Vector3d> points = ballPoints(1.0, scale);
    for (Vector3d& p : points) p = p.cwiseProduct(axes);
    return ConvexBody(points);
  };
  const auto ellipsoid = [&](const ConvexBody& b) {
    return RoundPair{ConvexBody(fcl::Ellipsoidd(axes)), b, scaled(1.0), scaled(kAround)};
  };
  return {ball(box),         ball(triangle), ball(hull),     capsule(box),
          capsule(triangle), capsule(hull),  ellipsoid(box), ellipsoid(hull)};
}

TEST_CASE("swept polytopes in a plane are between polytopes, and are certified to six digits") {
  RandomBodies random(402);
  int asked = 0, wide = 0;
  for (const double size : {0.05, 1.0, 20.0}) {
    for (int k = 0; k < 8; ++k) {
      for (const RoundPair& pair : roundPairs(random, size)) {
        const auto error = GaussianDisplacement::fromStandardDeviations(
            {1.0, random.uniform(0.2, 1.0), 0.0}, random.quaternion());
        const Pose pose_a = random.pose(0.1);
        Pose pose_b = random.pose(0.7 * size);
        pose_b.translation() += random.uniform(0.0, 6.0) * error.axes().col(k % 2);
        const Bounds mass = convexPairMass(pair.a, pose_a, pair.b, pose_b, error);
        const double least = convexPairMass(pair.within, pose_a, pair.b, pose_b, error).lower,
                     most = convexPairMass(pair.around, pose_a, pair.b, pose_b, error).upper;
        INFO("size " << size << ": " << mass.lower << " to " << mass.upper << ", polytopes "
                     << least << " to " << most);
        CHECK(mass.upper >= least * (1.0 - 1e-12));
        CHECK(mass.lower <= most * (1.0 + 1e-12));
        const Bounds swapped = convexPairMass(pair.b, pose_b, pair.a, pose_a, error.reversed());
        CHECK(swapped.lower <= mass.upper);
        CHECK(mass.lower <= swapped.upper);
        ++asked;
        wide += mass.width() > std::max(2.5e-7 * mass.upper, 1e-290);
      }
    }
  }
  CHECK(wide * 20 <= asked);
}

TEST_CASE("planes along faces and edges and through corners of swept polytopes") {
  const fcl::Sphered sphere(0.25);
  const fcl::Boxd box(1.0, 0.6, 0.4);
  for (const double height : {0.0, 0.1, 0.2, 0.2 + 1e-13, 0.3, 0.45 - 1e-9, 0.45, 0.45 + 1e-9}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3d deviations(0.5, 0.3, 0.4);
      deviations[axis] = 0.0;
      const auto error = GaussianDisplacement::fromStandardDeviations(deviations);
      Pose pose = Pose::Identity();
      const Vector3d half(0.5, 0.3, 0.2);
      pose.translation()[axis] = half[axis] - 0.2 + height;
      const double beyond = std::max(0.0, height - 0.2);
      const int x = (axis + 1) % 3, y = (axis + 2) % 3;
      const double disc = beyond < 0.25 ? std::sqrt((0.25 - beyond) * (0.25 + beyond)) : 0.0;
      // A rectangle swept by the disc that is left of the ball.
      const double hx = half[x], hy = half[y];
      const double truth =
          beyond < 0.25
              ? integrateOver({-hx - disc, -hx, hx, hx + disc},
                              [&](double u) {
                                const double off = std::max(0.0, std::abs(u) - hx);
                                const double end =
                                    hy + std::sqrt(std::max(0.0, (disc - off) * (disc + off)));
                                return densityAt(u / deviations[x]) / deviations[x] *
                                       massBetween(-end / deviations[y], end / deviations[y]);
                              })
              : 0.0;
      const Bounds mass =
          roundedMass(ConvexBody(sphere), Pose::Identity(), ConvexBody(box), pose, error);
      INFO("height " << height << " along " << axis << ": " << mass.lower << " to " << mass.upper
                     << ", truth " << truth);
      CHECK(mass.lower <= truth * (1.0 + 1e-7));
      CHECK(mass.upper >= truth * (1.0 - 1e-7));
      if (height < 0.45 - 1e-8) CHECK(mass.width() <= 2.5e-7 * mass.upper);
    }
  }
}

}  // namespace
