// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/robot_among_obstacles.h"

#include <fnmatch.h>

#include <algorithm>

#include "fcl_prob/exceptions.h"
#include "robot/moving_obstacle.h"
#include "robot/robot_notes.h"

namespace fcl_prob::detail {
namespace {

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

bool isSameBody(const ObstacleBody& x, const ObstacleBody& y) {
  return x.geometry == y.geometry && x.in_obstacle.matrix() == y.in_obstacle.matrix();
}

/// Whether one was prepared as the other is to be.
bool isSameThing(const Obstacle& x, const Obstacle& y) {
  return x.geometry == y.geometry && x.name == y.name &&
         std::equal(x.more.begin(), x.more.end(), y.more.begin(), y.more.end(), &isSameBody);
}

void validatePoses(const Obstacle& obstacle) {
  validatePose(obstacle.pose, "obstacle " + obstacle.name);
  for (const ObstacleState& state : obstacle.over_time) {
    validatePose(state.pose, "obstacle " + obstacle.name);
  }
}

PreparedGeometries geometriesOf(const std::vector<RobotBody>& bodies, const PreparedRobot* before) {
  PreparedGeometries geometries;
  if (before != nullptr) geometries = before->geometries;
  for (std::size_t i = geometries.size(); i < bodies.size(); ++i) {
    geometries.push_back(std::make_shared<const PreparedGeometry>(bodies[i].geometry,
                                                                  "a body of " + bodies[i].name()));
  }
  return geometries;
}

}  // namespace

PreparedRobot::PreparedRobot(const std::vector<RobotBody>& bodies, const PreparedRobot* before)
    : geometries(geometriesOf(bodies, before)),
      hulls(geometries, before != nullptr ? &before->hulls : nullptr) {
  for (const auto& geometry : geometries) balls.push_back(ballAround(*geometry));
}

RobotAmongObstacles::RobotAmongObstacles(const Robot& robot, std::vector<Obstacle> obstacles,
                                         std::vector<AllowedContact> allowed,
                                         const RobotAmongObstacles* before)
    : robot_(robot),
      bodies_(robot.prepared()),
      obstacles_(std::move(obstacles)),
      allowed_(std::move(allowed)) {
  if (obstacles_.empty()) throw InvalidRequest("a robot query needs an obstacle");
  if (before == nullptr) {
    for (const AllowedContact& one : allowed_) requireKnown(one);
  }
  for (const Obstacle& obstacle : obstacles_) {
    validatePoses(obstacle);
    requireTimes(obstacle);
    for (std::size_t i = 0; before != nullptr && i < before->obstacles_.size(); ++i) {
      if (!isSameThing(before->obstacles_[i], obstacle)) continue;
      prepared_.push_back(before->prepared_[i]);
      break;
    }
    if (prepared_.size() < bodies_of_.size() + 1) {
      prepared_.push_back(std::make_shared<const PreparedObstacle>(obstacle));
    }
    bodies_of_.push_back(meeting(obstacle, *prepared_.back()));
  }
  notes_ = standingNotes(this->robot(), obstacles_);
}

// What is allowed of a name that is not there would be a slip of the pen.
void RobotAmongObstacles::requireKnown(const AllowedContact& allowed) const {
  const auto& bodies = robot().bodies();
  if (std::none_of(bodies.begin(), bodies.end(),
                   [&](const RobotBody& body) { return matches(allowed.body, body.name()); })) {
    throw InvalidRequest("an allowed contact names the body " + allowed.body + ", which " +
                         robot().name() + " does not have");
  }
  if (std::none_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& obstacle) {
        return matches(allowed.obstacle, obstacle.name);
      })) {
    throw InvalidRequest("an allowed contact names the obstacle " + allowed.obstacle +
                         ", which is not there");
  }
}

std::vector<std::size_t> RobotAmongObstacles::meeting(const Obstacle& obstacle,
                                                      const PreparedObstacle& prepared) const {
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < robot().bodies().size(); ++i) {
    const std::string& name = robot().bodies()[i].name();
    const bool is_allowed =
        std::any_of(allowed_.begin(), allowed_.end(), [&](const AllowedContact& one) {
          return matches(one.body, name) && matches(one.obstacle, obstacle.name);
        });
    if (!is_allowed && prepared.mayMeet(geometries()[i]->geometry())) bodies.push_back(i);
  }
  return bodies;
}

ProbabilityResult RobotAmongObstacles::ask(std::size_t obstacle,
                                           const std::vector<PlacedBody>& bodies,
                                           const ProbabilityRequest& request,
                                           FarBodies& left_out) const {
  return placedProbability(sceneOf(obstacle), stateAt(obstacles_[obstacle], 0), bodies, request,
                           left_out);
}

std::vector<PlacedBody> RobotAmongObstacles::placed(
    std::size_t obstacle, const std::vector<fcl::Transform3d>& poses) const {
  std::vector<PlacedBody> bodies;
  for (const std::size_t body : bodies_of_[obstacle]) bodies.push_back({body, poses[body]});
  return bodies;
}

std::vector<std::vector<fcl::Transform3d>> RobotAmongObstacles::posesAt(
    const std::vector<Eigen::VectorXd>& waypoints) const {
  std::vector<std::vector<fcl::Transform3d>> poses;
  for (const Eigen::VectorXd& values : waypoints) poses.push_back(robot().poses(values));
  return poses;
}

std::vector<std::vector<PlacedBody>> RobotAmongObstacles::relativeTo(
    const std::vector<Eigen::VectorXd>& waypoints, int body) const {
  const auto all = posesAt(waypoints);
  std::vector<std::vector<PlacedBody>> relative;
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const auto offsets = offsetsSinceFirst(obstacles_[i], waypoints.size());
    std::vector<PlacedBody>& of_one = relative.emplace_back();
    for (const std::size_t counted : bodies_of_[i]) {
      if (body >= 0 && counted != static_cast<std::size_t>(body)) continue;
      for (std::size_t k = 0; k < all.size(); ++k) {
        PlacedBody one{counted, all[k][counted]};
        one.pose.translation() -= offsets[k];
        const bool stays = !of_one.empty() && of_one.back().body == counted &&
                           of_one.back().pose.matrix() == one.pose.matrix();
        if (!stays) of_one.push_back(one);
      }
    }
  }
  return relative;
}

std::vector<WaypointBody> RobotAmongObstacles::nearBodies(
    std::size_t obstacle, const std::vector<std::vector<fcl::Transform3d>>& poses,
    double least) const {
  const ObstacleState state = stateAt(obstacles_[obstacle], 0);
  const Ball around = prepared_[obstacle]->around().placed(state.pose);
  const auto offsets = offsetsSinceFirst(obstacles_[obstacle], poses.size());
  std::vector<WaypointBody> near;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    for (PlacedBody one : placed(obstacle, poses[k])) {
      one.pose.translation() -= offsets[k];
      const Ball ball = balls()[one.body].placed(one.pose);
      if (farContactUpper(ball, around, state.displacement) <= least) continue;
      near.push_back({k, one.body, one.pose, -offsets[k]});
    }
  }
  return near;
}

}  // namespace fcl_prob::detail
