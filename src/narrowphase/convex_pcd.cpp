// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/convex_pcd.h"

#include "cobstacle/convex_body_data.h"
#include "narrowphase/convex_pair_mass.h"
#include "narrowphase/pair_bounds.h"

namespace fcl_prob {

ConvexPcdBounds detail::convexPcd(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                  const ConvexBody& b, const fcl::Transform3d& pose_b,
                                  const GaussianDisplacement& displacement,
                                  const Interruption& interruption) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  PairBounds pair;
  pair.setInterruption(interruption);
  return pair.bounds(*PairObstacle(frame, a.data(), b.data()));
}

ConvexPcdBounds convexPcd(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                          const fcl::Transform3d& pose_b,
                          const GaussianDisplacement& displacement) {
  return detail::convexPcd(a, pose_a, b, pose_b, displacement, {});
}

ConvexPcdBaselines convexPcdBaselines(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                      const ConvexBody& b, const fcl::Transform3d& pose_b,
                                      const GaussianDisplacement& displacement) {
  const detail::PairFrame frame = detail::pairFrame(a, pose_a, b, pose_b, displacement);
  return detail::PairBounds().baselines(*detail::PairObstacle(frame, a.data(), b.data()));
}

}  // namespace fcl_prob
