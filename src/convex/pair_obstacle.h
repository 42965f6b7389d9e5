// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacle of two convex bodies.
#pragma once

#include <variant>

#include "convex/c_obstacle.h"
#include "fcl_prob/convex_body.h"

namespace fcl_prob::detail {

/// The frame of a pair of bodies. \throws InvalidPose if a pose is not finite or not rigid;
/// InvalidGeometry if both are too small to be measured (geometry/validation.h)
PairFrame pairFrame(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                    const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement);

/// The C-obstacle of a pair by the structure that fits it best.
class PairObstacle {
 public:
  PairObstacle(const PairFrame& frame, const ConvexSet& a, const ConvexSet& b);

  const CObstacle& operator*() const;
  const CObstacle* operator->() const { return &**this; }

 private:
  std::variant<std::monostate, ZonotopeObstacle, ConvexSetObstacle> obstacle_;
};

}  // namespace fcl_prob::detail
