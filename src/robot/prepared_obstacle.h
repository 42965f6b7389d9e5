// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What queries keep of an obstacle, wherever it is and whatever its error.
#pragma once

#include <vector>

#include "fcl_prob/robot_query.h"
#include "query/member_group.h"
#include "robot/body_balls.h"
#include "robot/node_hulls.h"

namespace fcl_prob::detail {

/// The bodies of one obstacle, which are displaced as one. Const calls are safe on several threads.
class PreparedObstacle {
 public:
  /// \throws InvalidGeometry, UnsupportedGeometry, InvalidPose
  explicit PreparedObstacle(const Obstacle& obstacle);

  const MemberGroup& group() const { return group_; }
  const PreparedGeometries& geometries() const { return group_.members(); }

  /// Of the bodies, where the obstacle is at a pose.
  std::vector<fcl::Transform3d> poses(const fcl::Transform3d& pose) const;

  const HullsOfBodies& hulls() const { return hulls_; }

  /// Around all of it, in its frame.
  const Ball& around() const { return around_; }

  /// Whether fcl::collide may ever find a geometry in contact with it.
  bool mayMeet(const fcl::CollisionGeometryd& geometry) const;

 private:
  MemberGroup group_;
  HullsOfBodies hulls_;
  std::vector<fcl::Transform3d> in_obstacle_;
  Ball around_;
};

}  // namespace fcl_prob::detail
