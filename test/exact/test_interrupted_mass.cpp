// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The mass of a convex pair, interrupted anywhere, is an interval that holds the mass.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>

#include <Eigen/Geometry>
#include <limits>
#include <utility>
#include <vector>

#include "bounds/convex_bound.h"
#include "catch.h"
#include "exact/convex_pair_mass.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;

ConvexBody randomHull(RandomBodies& random, int points) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < points; ++i) {
    corners.push_back({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
  }
  return ConvexBody(corners);
}

}  // namespace

TEST_CASE("the mass of a convex pair interrupted at any moment", "[narrowphase]") {
  RandomBodies random(5);
  const ConvexBody hull = randomHull(random, 60);
  const ConvexBody other = randomHull(random, 40);
  const ConvexBody sphere{fcl::Sphered(0.8)};
  const ConvexBody cylinder{fcl::Cylinderd(0.6, 1.1)};
  const std::vector<std::pair<const ConvexBody*, const ConvexBody*>> pairs{
      {&hull, &other}, {&sphere, &cylinder}, {&hull, &sphere}};
  const fcl::Transform3d pose_a = fcl::Transform3d::Identity();
  fcl::Transform3d pose_b(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  pose_b.translation() = Eigen::Vector3d(1.6, 0.4, 0.3);
  for (const Eigen::Vector3d& sigma : {Eigen::Vector3d(0.4, 0.3, 0.5), Eigen::Vector3d(0.4, 0.3, 0),
                                       Eigen::Vector3d(400, 300, 1e-3)}) {
    const auto displacement = GaussianDisplacement::fromStandardDeviations(sigma);
    for (const auto& [a, b] : pairs) {
      const auto massUntil = [&, a = a, b = b](long last) {
        long polls = 0;
        const Bounds mass = detail::convexPairMass(*a, pose_a, *b, pose_b, displacement,
                                                   [&] { return ++polls >= last; });
        CHECK(mass.lower >= 0.0);
        CHECK(mass.upper <= 1.0);
        return std::make_pair(mass, polls);
      };
      const auto [whole, polls] = massUntil(std::numeric_limits<long>::max());
      CHECK(whole.width() < 0.2 * whole.upper);
      CHECK(massUntil(1).first.width() > 2.0 * whole.width());
      const auto bounds = [&, a = a, b = b](bool interrupted) {
        return detail::convexPcd(*a, pose_a, *b, pose_b, displacement, [=] { return interrupted; });
      };
      CHECK(bounds(true).least >= whole.lower);
      CHECK(bounds(false).least >= whole.lower);
      CHECK(massUntil(polls).first.lower <= whole.lower);
      for (int i = 0; i < 10; ++i) {
        const Bounds mass = massUntil(random.integer(1, static_cast<int>(polls))).first;
        CAPTURE(sigma, mass.lower, mass.upper, whole.lower, whole.upper);
        CHECK(mass.lower <= whole.lower);
        CHECK(mass.upper >= whole.upper * (1 - 1e-12));
      }
    }
  }
}
