// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A robot and obstacles, prepared, and which bodies of the one may touch which of the others.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "robot/obstacle_gradient.h"
#include "robot/placed_query.h"
#include "robot/prepared_obstacle.h"
#include "robot/prepared_robot.h"

namespace fcl_prob::detail {

/// Immutable; one with other obstacles shares what was prepared.
class RobotAmongObstacles {
 public:
  /// \throws as RobotQuery
  RobotAmongObstacles(const Robot& robot, std::vector<Obstacle> obstacles,
                      std::vector<AllowedContact> allowed, const RobotAmongObstacles* before);

  const Robot& robot() const { return robot_; }
  const PreparedRobot& prepared() const { return *bodies_; }
  const PreparedGeometries& geometries() const { return bodies_->geometries; }
  const std::vector<Ball>& balls() const { return bodies_->balls; }
  const std::vector<Obstacle>& obstacles() const { return obstacles_; }
  const std::vector<AllowedContact>& allowed() const { return allowed_; }
  const PreparedObstacle& preparedObstacle(std::size_t i) const { return *prepared_[i]; }

  /// The bodies that count for an obstacle: which may touch it and are not allowed to.
  const std::vector<std::size_t>& bodiesOf(std::size_t obstacle) const {
    return bodies_of_[obstacle];
  }

  /// Notes that are told with every answer.
  const std::vector<std::string>& notes() const { return notes_; }

  ObstacleAmongBodies sceneOf(std::size_t obstacle) const {
    return {*bodies_, *prepared_[obstacle]};
  }

  /// P that any of the bodies touches an obstacle where that is at first: see placedProbability().
  ProbabilityResult ask(std::size_t obstacle, const std::vector<PlacedBody>& bodies,
                        const ProbabilityRequest& request, FarBodies& left_out) const;

  /// The bodies that count for an obstacle, of all in a state.
  std::vector<PlacedBody> placed(std::size_t obstacle,
                                 const std::vector<fcl::Transform3d>& poses) const;

  /// Errors that are the same all along: an obstacle that has shifted is where it was at first, and
  /// the bodies have shifted the other way. By obstacle; of each, body by body along the motion,
  /// and once where it stays. \param body  the only one that counts, or -1
  std::vector<std::vector<PlacedBody>> relativeTo(const std::vector<Eigen::VectorXd>& waypoints,
                                                  int body) const;

  /// Those of them that are likelier than `least` to touch an obstacle.
  std::vector<WaypointBody> nearBodies(std::size_t obstacle,
                                       const std::vector<std::vector<fcl::Transform3d>>& poses,
                                       double least) const;

  /// Poses of all bodies at each waypoint.
  std::vector<std::vector<fcl::Transform3d>> posesAt(
      const std::vector<Eigen::VectorXd>& waypoints) const;

 private:
  void requireKnown(const AllowedContact& allowed) const;
  std::vector<std::size_t> meeting(const Obstacle& obstacle, const PreparedObstacle& body) const;

  Robot robot_;
  std::shared_ptr<const PreparedRobot> bodies_;
  std::vector<Obstacle> obstacles_;
  std::vector<AllowedContact> allowed_;
  std::vector<std::shared_ptr<const PreparedObstacle>> prepared_;
  std::vector<std::vector<std::size_t>> bodies_of_;
  std::vector<std::string> notes_;
};

}  // namespace fcl_prob::detail
