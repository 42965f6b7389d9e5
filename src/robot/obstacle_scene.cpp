// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/obstacle_scene.h"

#include "io/scene_parts.h"

namespace fcl_prob::detail {
namespace {

SceneObject readBody(StrictObject object, const std::filesystem::path& folder) {
  SceneObject body = readShapeAndPose(object, folder);
  object.finish();
  return body;
}

/// A shape, several of them, or a robot in some state.
void readBodies(StrictObject& object, const std::filesystem::path& folder,
                RobotScene::PlacedObstacle& obstacle) {
  if (!object.has("bodies") && !object.has("robot")) {
    obstacle.object = readShapeAndPose(object, folder);
    return;
  }
  if (const auto pose = readPose(object, "pose")) obstacle.object.pose = *pose;
  if (object.oneOf({"bodies", "robot"}) == "bodies") {
    for (StrictObject& body : object.objects("bodies")) {
      obstacle.bodies.push_back(readBody(std::move(body), folder));
    }
    if (obstacle.bodies.empty()) object.fail("bodies", "there are none");
    return;
  }
  StrictObject of_robot = object.object("robot");
  RobotScene::StandingRobot robot;
  robot.urdf = readUrdfOptions(of_robot, folder, robot.options);
  if (of_robot.has("joints")) robot.joints = of_robot.object("joints").numbersByName();
  of_robot.finish();
  obstacle.robot = std::move(robot);
}

// What a state does not say is as it is for the whole motion.
std::vector<ObstacleState> readStatesOverTime(StrictObject& object,
                                              const RobotScene::PlacedObstacle& obstacle) {
  std::vector<ObstacleState> states;
  for (StrictObject& entry : object.objects("over_time")) {
    ObstacleState state{obstacle.object.pose, obstacle.displacement};
    if (const auto pose = readPose(entry, "pose")) state.pose = *pose;
    if (entry.has("displacement")) {
      state.displacement = readDisplacement(entry.object("displacement"));
    }
    if (entry.has("time")) state.time = entry.number("time");
    entry.finish();
    states.push_back(std::move(state));
  }
  return states;
}

/// In the frame of the obstacle.
Obstacle unplaced(const RobotScene::PlacedObstacle& obstacle) {
  Obstacle result;
  if (obstacle.robot) {
    RobotOptions options = obstacle.robot->options;
    options.base = fcl::Transform3d::Identity();
    const Robot robot(obstacle.robot->urdf, options);
    return obstacleOf(obstacle.name, robot, robot.values(obstacle.robot->joints),
                      obstacle.displacement);
  }
  if (obstacle.bodies.empty()) return withShape(result, obstacle.object);
  result.pose = obstacle.bodies[0].pose;
  result = withShape(result, obstacle.bodies[0]);
  for (std::size_t i = 1; i < obstacle.bodies.size(); ++i) {
    const Obstacle body = withShape(Obstacle(), obstacle.bodies[i]);
    result.more.push_back({body.geometry, result.pose.inverse() * obstacle.bodies[i].pose});
    result.coordinate_error = std::max(result.coordinate_error, body.coordinate_error);
    result.notes.insert(result.notes.end(), body.notes.begin(), body.notes.end());
  }
  return result;
}

}  // namespace

std::string besideScene(const std::filesystem::path& folder, const std::string& path) {
  return (folder / path).lexically_normal().string();
}

std::string readUrdfOptions(StrictObject& object, const std::filesystem::path& folder,
                            RobotOptions& options) {
  if (object.has("packages")) {
    for (const auto& [name, path] : object.object("packages").textsByName()) {
      options.packages[name] = besideScene(folder, path);
    }
  }
  if (object.has("links")) options.links = object.texts("links");
  if (object.has("allow_outside_limits")) {
    options.allow_outside_limits = object.boolean("allow_outside_limits");
  }
  return besideScene(folder, object.text("urdf"));
}

RobotScene::PlacedObstacle readObstacle(StrictObject object, const std::filesystem::path& folder) {
  RobotScene::PlacedObstacle obstacle;
  obstacle.name = object.text("name");
  readBodies(object, folder, obstacle);
  obstacle.displacement = readDisplacement(object.object("displacement"));
  if (object.has("over_time")) obstacle.over_time = readStatesOverTime(object, obstacle);
  object.finish();
  return obstacle;
}

Obstacle loadObstacle(const RobotScene::PlacedObstacle& placed,
                      const std::vector<ObstacleState>& states) {
  Obstacle obstacle = unplaced(placed);
  // The query's frame of an obstacle is that of its first body.
  const fcl::Transform3d first = obstacle.pose;
  const bool moves_frame = !first.matrix().isIdentity(0.0);
  const auto of_first = [&](const fcl::Transform3d& pose) {
    return moves_frame ? pose * first : pose;
  };
  obstacle.name = placed.name;
  obstacle.displacement = placed.displacement;
  obstacle.pose = of_first(placed.object.pose);
  for (const ObstacleState& state : states) {
    obstacle.over_time.push_back({of_first(state.pose), state.displacement, state.time});
  }
  return obstacle;
}

}  // namespace fcl_prob::detail
