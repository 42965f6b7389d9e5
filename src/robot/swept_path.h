// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the bodies of a robot sweep along a motion, in steps that can be halved.
#pragma once

#include <utility>
#include <vector>

#include "robot/body_sweep.h"
#include "robot/moving_obstacle.h"
#include "robot/prepared_robot.h"

namespace fcl_prob::detail {

/// What one body does in a part of the motion: between two times, or at the waypoints among them.
/// Waypoint i is at time i.
struct SweptBody {
  std::size_t body;
  double first, last;  ///< times; within one way from a waypoint to the next, or waypoints both
  BodySweep sweep;
  double weight;     ///< its share of all that all bodies do, before anything was halved
  double far_upper;  ///< bound on its own probability, once it is known
};

/// A motion that is linear in the joints between waypoints, and so is the obstacle's; or its
/// waypoints only.
class SweptPath {
 public:
  /// Keeps references to the first three.
  /// \param balls     around the bodies, in their frames
  /// \param bodies    those of the robot that count
  /// \param obstacle  relative to which the bodies move
  SweptPath(const Robot& robot, const std::vector<Ball>& balls,
            const std::vector<Eigen::VectorXd>& waypoints, std::vector<std::size_t> bodies,
            const Obstacle& obstacle, BetweenWaypoints between)
      : robot_(robot),
        balls_(balls),
        waypoints_(waypoints),
        bodies_(std::move(bodies)),
        offsets_(offsetsSinceFirst(obstacle, waypoints.size())),
        obstacle_size_(largestPosition(obstacle)),
        between_(between) {}

  /// All that all bodies do: one step each.
  std::vector<SweptBody> wholeSteps() const;

  /// Two steps in place of one; nothing if they would be no shorter but for rounding.
  std::vector<SweptBody> halvesOf(const SweptBody& step) const;

  /// Where a body is at some time.
  PlacedBody at(std::size_t body, double time) const;

  /// Waypoints in a step, where nothing else counts; else 1.
  std::size_t statesIn(const SweptBody& step) const;

 private:
  SweptBody part(std::size_t body, double first, double last, double weight) const;
  SweptBody between(std::size_t body, double first, double last) const;
  SweptBody across(std::size_t body, std::size_t first, std::size_t last) const;

  const Robot& robot_;
  const std::vector<Ball>& balls_;
  const std::vector<Eigen::VectorXd>& waypoints_;
  std::vector<std::size_t> bodies_;
  std::vector<Eigen::Vector3d> offsets_;  ///< of the obstacle since the first waypoint
  double obstacle_size_;                  ///< of the positions that they are differences of
  BetweenWaypoints between_;
};

}  // namespace fcl_prob::detail
