// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/certified_motion.h"

#include <memory>
#include <ostream>
#include <sstream>
#include <string>

#include "cells/without_contact.h"
#include "fcl_prob/exceptions.h"
#include "query/certified_answer.h"
#include "robot/moving_obstacle.h"
#include "robot/obstacle_answer.h"

namespace fcl_prob::detail {
namespace {

/// What one obstacle has to do with all placed bodies.
struct Event {
  const Obstacle& obstacle;
  const PreparedObstacle& prepared;
  std::unique_ptr<const MemberGroup> bodies;  ///< null: no body may touch it
  std::vector<fcl::Transform3d> poses;
  std::string certificate;
};

Event eventOf(const RobotAmongObstacles& among, std::size_t i,
              const std::vector<PlacedBody>& placed) {
  PreparedGeometries geometries;
  std::vector<fcl::Transform3d> poses;
  for (const PlacedBody& body : placed) {
    geometries.push_back(among.geometries()[body.body]);
    poses.push_back(body.pose);
  }
  std::unique_ptr<const MemberGroup> bodies;
  if (!placed.empty()) bodies = std::make_unique<const MemberGroup>(geometries, "the robot");
  return {among.obstacles()[i], among.preparedObstacle(i), std::move(bodies), std::move(poses), {}};
}

ProbabilityResult ask(Event& event, const ProbabilityRequest& request) {
  if (!event.bodies) return withoutContact(request, "no body may touch it");
  const ObstacleState state = stateAt(event.obstacle, 0);
  const auto* gaussian = std::get_if<GaussianDisplacement>(&state.displacement);
  if (!gaussian) {
    throw UnsupportedGeometry("no certificate of obstacle " + event.obstacle.name +
                              ", whose displacement is not Gaussian");
  }
  std::ostringstream text;
  const std::vector<fcl::Transform3d> of_obstacle = event.prepared.poses(state.pose);
  ProbabilityResult result =
      certifiedAnswer({event.prepared.group(), of_obstacle, "obstacle " + event.obstacle.name},
                      {*event.bodies, event.poses, "the robot"}, *gaussian, request, text);
  event.certificate = text.str();
  return result;
}

}  // namespace

// What is asked again, with more of the limits, proves at least as much.
RobotResult certifiedMotion(const RobotAmongObstacles& among,
                            const std::vector<Eigen::VectorXd>& waypoints,
                            const ProbabilityRequest& request, std::ostream& certificate) {
  const auto relative = among.relativeTo(waypoints, -1);
  std::vector<Event> events;
  for (std::size_t i = 0; i < relative.size(); ++i) {
    events.push_back(eventOf(among, i, relative[i]));
  }
  RobotResult result = anyOfAsked(
      std::vector<Bounds>(events.size(), Bounds{0.0, 1.0}), request,
      [&](std::size_t i, const ProbabilityRequest& of_one) { return ask(events[i], of_one); });
  for (const Event& event : events) certificate << event.certificate;
  result.plan = among.notes();
  return result;
}

}  // namespace fcl_prob::detail
