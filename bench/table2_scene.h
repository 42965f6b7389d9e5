// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The two scenes of the paper's Table II, as far as it tells them, for a Fetch arm.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/robot_query.h"
#include "fcl_prob/self_collision.h"
#include "fcl_prob/timed_planning.h"
#include "robot/state_screen.h"

namespace fcl_prob::cli {

/// Something whose place is known: it is touched or not, by fcl::collide.
struct ExactObstacle {
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  fcl::Transform3d pose;  ///< metres, world frame
};

/// The robot among obstacles where they are at one time.
struct Table2Around {
  explicit Table2Around(RobotQuery of) : query(std::move(of)), screen(query.among()) {}

  RobotQuery query;  ///< arm, gripper and what it holds
  detail::StateScreen screen;
};

/// A state of the robot at its time.
struct Table2State {
  const Eigen::VectorXd& values;
  const RobotQuery& query;
  const detail::StateScreen& screen;  ///< of the query

  /// By the screen.
  std::optional<bool> isBelow(double threshold) const {
    ProbabilityRequest request;
    request.threshold = threshold;
    return screen.isBelow(values, request);
  }
};

struct Table2Scene {
  std::string name;
  SelfCollision self;  ///< all of the robot
  std::vector<ExactObstacle> exact;
  Eigen::VectorXd start;
  Eigen::VectorXd goal;
  std::vector<std::string> joints;  ///< that move

  /// At the times that obstacles are predicted for, evenly from 0 s to `end`, the same ones; once
  /// where they stay.
  std::vector<std::shared_ptr<const Table2Around>> around;
  double end = 0.0;  ///< seconds

  const fcl_prob::Robot& robot() const { return around.front()->query.robot(); }
  const std::vector<Obstacle>& obstacles() const { return around.front()->query.obstacles(); }

  bool isTimed() const { return around.size() > 1; }

  /// Among the obstacles as predicted for the time that is closest.
  Table2State at(const TimedWaypoint& state) const;

  /// Whether the robot touches neither itself nor what is exact.
  bool isFree(const Eigen::VectorXd& values) const;
};

/// "cans": the arm carries a can over a table with two more and past a human arm; the table is
/// exact. "waving": the arm goes past a human arm that waves, predicted every tenth of a second
/// with a covariance that grows; time is a dimension of its plans.
/// \param models_folder  holds fetch_robot/, human/ and objects/
std::vector<Table2Scene> table2Scenes(const std::string& models_folder);

/// An arm that waves closer by, at four times, each by itself with its covariance.
std::vector<Table2Scene> singleArmScenes(const std::string& models_folder);

}  // namespace fcl_prob::cli
