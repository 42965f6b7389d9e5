// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/pair_obstacle.h"

#include "geometry/validation.h"

namespace fcl_prob::detail {

PairFrame pairFrame(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                    const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement) {
  validatePose(pose_a, "pose of A");
  validatePose(pose_b, "pose of B");
  PairFrame frame(displacement, pose_a, a.set().size(), pose_b, b.set().size());
  frame.error += a.set().slack() + b.set().slack();
  return frame;
}

PairObstacle::PairObstacle(const PairFrame& frame, const ConvexSet& a, const ConvexSet& b) {
  if (a.rounded() && b.rounded()) {
    obstacle_.emplace<ZonotopeObstacle>(frame, *a.rounded(), *b.rounded());
  } else {
    obstacle_.emplace<ConvexSetObstacle>(frame, a, b);
  }
}

const CObstacle& PairObstacle::operator*() const {
  if (const auto* zonotope = std::get_if<ZonotopeObstacle>(&obstacle_)) return *zonotope;
  return std::get<ConvexSetObstacle>(obstacle_);
}

}  // namespace fcl_prob::detail
