// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of pairs of k-DOPs, whose planes meet in the vertices of what they contain.
#include "catch.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/kdop26.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;

template <typename BV>
ConvexBody around(const std::vector<Eigen::Vector3d>& points) {
  BV volume;
  for (const Eigen::Vector3d& point : points) volume += point;
  return ConvexBody(volume);
}

std::vector<Eigen::Vector3d> cloud(const Eigen::Vector3d& centre, RandomBodies& random) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 12; ++i) points.push_back(centre + 0.3 * random.normalVector());
  return points;
}

struct Count {
  int likely = 0;  ///< pairs whose probability says something
  int wide = 0;    ///< of these, those whose faces could not be had
};

void checkNested(RandomBodies& random, Count& count) {
  const auto a = cloud(Eigen::Vector3d::Zero(), random), b = cloud({1.5, 0.4, 0.2}, random);
  const auto displacement =
      GaussianDisplacement::fromStandardDeviations({0.3, 0.1, 0.2}, random.quaternion());
  const fcl::Transform3d pose = fcl::Transform3d::Identity();
  const auto mass = [&](const ConvexBody& of_a, const ConvexBody& of_b) {
    return convexPairMass(of_a, pose, of_b, pose, displacement);
  };
  const Bounds hulls = mass(ConvexBody(a), ConvexBody(b));
  const Bounds dops = mass(around<Kdop26>(a), around<Kdop26>(b));
  const Bounds fewer = mass(around<fcl::KDOPd<18>>(a), around<fcl::KDOPd<18>>(b));
  const Bounds boxes = mass(around<fcl::AABBd>(a), around<fcl::AABBd>(b));
  CHECK(hulls.lower <= dops.upper);
  CHECK(dops.lower <= fewer.upper);
  CHECK(fewer.lower <= boxes.upper);
  if (dops.upper < 1e-12) return;
  ++count.likely;
  if (dops.width() > 1e-6 * dops.upper || fewer.width() > 1e-6 * fewer.upper) ++count.wide;
}

}  // namespace

TEST_CASE("k-DOPs around the same points have masses between those of hulls and boxes",
          "[convex_pcd]") {
  RandomBodies random(41);
  Count count;
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    checkNested(random, count);
  }
  CHECK(count.likely > 100);
  CHECK(count.wide <= count.likely / 50);
}
