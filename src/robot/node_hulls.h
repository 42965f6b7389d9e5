// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex hulls of the nodes of a mesh, coarse to fine: what is near of a body that is not convex.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <memory>
#include <mutex>
#include <vector>

#include "query/prepared_geometry.h"
#include "robot/body_balls.h"
#include "robot/medial_balls.h"

namespace fcl_prob::detail {

/// The topology is that of the upper part of FCL's own tree.
struct NodeHulls {
  struct Node {
    ConvexBody hull;
    Ball ball;       ///< around it
    int left = -1;   ///< index of the first child, greater than the node's own; -1 at a leaf
    int right = -1;  ///< index of the second child
    bool isLeaf() const { return left < 0; }
  };

  std::vector<Node> nodes;  ///< nodes[0] is around everything
  double size = 0.0;        ///< metres: no vertex of a hull is farther from the origin
  double slack = 0.0;       ///< metres: by no more than this contents reach out of a hull
};

/// \param whole  around all of it: the only node of what is no mesh, or convex
NodeHulls nodeHullsOf(const fcl::CollisionGeometryd& geometry, const ConvexBody& whole);

/// Of several geometries, each when first asked for. Const calls are safe on several threads.
class HullsOfBodies {
 public:
  /// \param before  of the first of them: what it made is shared; null: nothing is
  explicit HullsOfBodies(PreparedGeometries geometries, const HullsOfBodies* before = nullptr);

  /// \pre  geometries[body] has a root body
  const NodeHulls& of(std::size_t body) const;

  const MedialBalls& ballsOf(std::size_t body) const;

 private:
  struct Kept {
    std::once_flag once;
    std::unique_ptr<const NodeHulls> hulls;
    std::once_flag balls_once;
    std::unique_ptr<const MedialBalls> balls;
  };

  PreparedGeometries geometries_;
  std::vector<std::shared_ptr<Kept>> kept_;
};

}  // namespace fcl_prob::detail
