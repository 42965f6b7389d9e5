// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/certified_motion.h"

#include <memory>
#include <ostream>
#include <sstream>
#include <string>

#include "cells/without_contact.h"
#include "fcl_prob/exceptions.h"
#include "query/groups_query.h"
#include "robot/moving_obstacle.h"
#include "robot/obstacle_answer.h"

namespace fcl_prob::detail {
namespace {

/// What one obstacle has to do with all placed bodies.
struct Event {
  GaussianDisplacement displacement;
  std::unique_ptr<const GroupsQuery> query;  ///< null: no body may touch the obstacle
  std::vector<fcl::Transform3d> of_obstacle;
  std::vector<fcl::Transform3d> of_bodies;
  std::string certificate;
};

Event eventOf(const RobotAmongObstacles& among, std::size_t i,
              const std::vector<PlacedBody>& placed) {
  const Obstacle& obstacle = among.obstacles()[i];
  const PreparedObstacle& prepared = among.preparedObstacle(i);
  if (placed.empty()) return {};
  const ObstacleState state = stateAt(obstacle, 0);
  const auto* gaussian = std::get_if<GaussianDisplacement>(&state.displacement);
  if (!gaussian) {
    throw UnsupportedGeometry("no certificate of obstacle " + obstacle.name +
                              ", whose displacement is not Gaussian");
  }
  Event event{*gaussian, nullptr, prepared.poses(state.pose), {}, {}};
  PreparedGeometries bodies;
  for (const PlacedBody& body : placed) {
    bodies.push_back(among.geometries()[body.body]);
    event.of_bodies.push_back(body.pose);
  }
  event.query = std::make_unique<const GroupsQuery>(prepared.geometries(), std::move(bodies),
                                                    prepared.group().name(), "the robot");
  return event;
}

ProbabilityResult ask(Event& event, const ProbabilityRequest& request) {
  if (!event.query) return withoutContact(request, "no body may touch it");
  std::ostringstream text;
  ProbabilityResult result =
      event.query->certified(event.of_obstacle, event.of_bodies, event.displacement, request, text);
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
  return result;
}

}  // namespace fcl_prob::detail
