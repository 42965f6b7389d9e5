// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/convex_pcd.h"

#include "cobstacle/convex_body_data.h"
#include "narrowphase/pair_bounds.h"

namespace fcl_prob {
ConvexPcdBounds convexPcd(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                          const fcl::Transform3d& pose_b,
                          const GaussianDisplacement& displacement) {
  const detail::PairFrame frame = detail::pairFrame(a, pose_a, b, pose_b, displacement);
  return detail::PairBounds().bounds(*detail::PairObstacle(frame, a.data(), b.data()));
}

ConvexPcdBaselines convexPcdBaselines(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                      const ConvexBody& b, const fcl::Transform3d& pose_b,
                                      const GaussianDisplacement& displacement) {
  const detail::PairFrame frame = detail::pairFrame(a, pose_a, b, pose_b, displacement);
  return detail::PairBounds().baselines(*detail::PairObstacle(frame, a.data(), b.data()));
}

}  // namespace fcl_prob
