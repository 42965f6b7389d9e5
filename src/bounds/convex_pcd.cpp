// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/convex_pcd.h"

#include "base/constants.h"
#include "bounds/convex_bound.h"
#include "bounds/pair_bounds.h"
#include "convex/nearest.h"
#include "convex/pair_obstacle.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob {
namespace {

// More than what a mass and the length of a unit vector are rounded by.
constexpr double kHalfSpaceRounding = 1e-9;

}  // namespace

ConvexPcdBounds detail::convexPcd(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                  const ConvexBody& b, const fcl::Transform3d& pose_b,
                                  const GaussianDisplacement& displacement,
                                  const Interruption& interruption) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  PairBounds pair;
  pair.setInterruption(interruption);
  return pair.bounds(*PairObstacle(frame, a.set(), b.set()));
}

double detail::halfSpaceUpper(const ConvexBody& a, const fcl::Transform3d& pose_a,
                              const ConvexBody& b, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  return halfSpaceUpper(*PairObstacle(frame, a.set(), b.set()));
}

double detail::halfSpaceUpper(const CObstacle& obstacle) {
  if (obstacle.frame().rank < 3 || !obstacle.frame().fits) return 1.0;
  const Eigen::Vector3d towards = gjkDirection(obstacle);
  if (!(towards.squaredNorm() > 0.5)) return 1.0;
  const double offset = -obstacle.support(-towards) * (1.0 - kHalfSpaceRounding);
  if (!(offset > 0.0)) return 1.0;
  return normalTailMass(offset) * (1.0 + kHalfSpaceRounding) + kUnderflow;
}

ConvexPcdBounds convexPcd(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                          const fcl::Transform3d& pose_b,
                          const GaussianDisplacement& displacement) {
  return detail::convexPcd(a, pose_a, b, pose_b, displacement, {});
}

}  // namespace fcl_prob
