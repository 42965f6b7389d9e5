// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/robot_scene.h"

#include <filesystem>

#include "io/quantities.h"
#include "io/scene_parts.h"
#include "io/strict_json.h"
#include "robot/moving_obstacle.h"
#include "robot/robot_notes.h"

namespace fcl_prob {
namespace {

using detail::StrictObject;

constexpr std::size_t kCellsOfPlannedState = 2'000;

std::string besideScene(const std::filesystem::path& folder, const std::string& path) {
  return (folder / path).lexically_normal().string();
}

RobotScene::CarriedObject readAttached(StrictObject object, const std::filesystem::path& folder) {
  RobotScene::CarriedObject attached;
  attached.name = object.text("name");
  attached.link = object.text("link");
  attached.object = detail::readShapeAndPose(object, folder);
  if (object.has("touch_links")) attached.touch_links = object.texts("touch_links");
  object.finish();
  return attached;
}

void readRobot(StrictObject object, const std::filesystem::path& folder, RobotScene& scene) {
  scene.urdf = besideScene(folder, object.text("urdf"));
  if (object.has("srdf")) scene.srdf = besideScene(folder, object.text("srdf"));
  if (object.has("packages")) {
    for (const auto& [name, path] : object.object("packages").textsByName()) {
      scene.robot.packages[name] = besideScene(folder, path);
    }
  }
  if (object.has("links")) scene.robot.links = object.texts("links");
  if (object.has("allow_outside_limits")) {
    scene.robot.allow_outside_limits = object.boolean("allow_outside_limits");
  }
  if (object.has("attached")) {
    for (StrictObject& attached : object.objects("attached")) {
      scene.attached.push_back(readAttached(std::move(attached), folder));
    }
  }
  if (object.has("base")) {
    const std::vector<double> numbers = object.numbers("base");
    try {
      scene.robot.base = detail::poseFrom(numbers);
    } catch (const Exception& error) {
      object.fail("base", error.what());
    }
  }
  object.finish();
}

// What a state does not say is as it is for the whole motion.
std::vector<ObstacleState> readStatesOverTime(StrictObject& object,
                                              const RobotScene::PlacedObstacle& obstacle) {
  std::vector<ObstacleState> states;
  for (StrictObject& entry : object.objects("over_time")) {
    ObstacleState state{obstacle.object.pose, obstacle.displacement};
    if (entry.has("pose")) {
      const std::vector<double> numbers = entry.numbers("pose");
      try {
        state.pose = detail::poseFrom(numbers);
      } catch (const Exception& error) {
        entry.fail("pose", error.what());
      }
    }
    if (entry.has("displacement")) {
      state.displacement = detail::readDisplacement(entry.object("displacement"));
    }
    entry.finish();
    states.push_back(std::move(state));
  }
  return states;
}

RobotScene::PlacedObstacle readObstacle(StrictObject object, const std::filesystem::path& folder) {
  RobotScene::PlacedObstacle obstacle;
  obstacle.name = object.text("name");
  obstacle.object = detail::readShapeAndPose(object, folder);
  obstacle.displacement = detail::readDisplacement(object.object("displacement"));
  if (object.has("over_time")) obstacle.over_time = readStatesOverTime(object, obstacle);
  object.finish();
  return obstacle;
}

RobotScene::Plan readPlan(StrictObject object) {
  RobotScene::Plan plan;
  plan.start = object.object("start").numbersByName();
  plan.goal = object.object("goal").numbersByName();
  if (object.has("joints")) plan.joints = object.texts("joints");
  if (object.has("motion_threshold")) plan.motion_threshold = object.number("motion_threshold");
  if (object.has("seed")) plan.seed = object.count("seed");
  if (object.has("max_states")) plan.max_states = object.count("max_states");
  object.finish();
  return plan;
}

/// One state, several, or two to be planned between.
void readStates(StrictObject& root, RobotScene& scene) {
  const std::string given = root.oneOf({"joints", "waypoints", "plan"});
  if (given == "plan") {
    scene.plan = readPlan(root.object("plan"));
  } else if (given == "joints") {
    scene.waypoints.push_back(root.object("joints").numbersByName());
  } else {
    for (const StrictObject& waypoint : root.objects("waypoints")) {
      scene.waypoints.push_back(waypoint.numbersByName());
    }
    if (scene.waypoints.empty()) root.fail("waypoints", "there are none");
  }
}

ErrorsOverTime readErrors(StrictObject& root) {
  const std::string errors = root.text("errors");
  if (errors == "persistent") return ErrorsOverTime::persistent;
  if (errors == "independent") return ErrorsOverTime::independent;
  if (errors == "any-dependence") return ErrorsOverTime::any_dependence;
  root.fail("errors", "none of persistent, independent and any-dependence");
}

BetweenWaypoints readBetween(StrictObject& root) {
  const std::string between = root.text("between");
  if (between == "ignored") return BetweenWaypoints::ignored;
  if (between != "swept") root.fail("between", "neither ignored nor swept");
  return BetweenWaypoints::swept;
}

/// Of an attached object or an obstacle. \returns what a query takes of its shape
template <class Of>
Of withShape(Of result, const SceneObject& object) {
  if (const auto* primitive = std::get_if<PrimitiveShape>(&object.shape)) {
    result.geometry = *primitive;
    return result;
  }
  const MeshFile& file = std::get<MeshFile>(object.shape);
  const TriangleMesh mesh = loadMeshIsolated(file.path, file.options);
  result.geometry = buildModel<fcl::OBBRSSd>(mesh);
  result.coordinate_error = mesh.coordinate_error;
  result.notes = mesh.notes;
  return result;
}

std::vector<Eigen::VectorXd> valuesOf(const RobotScene& scene, const Robot& robot) {
  std::vector<Eigen::VectorXd> waypoints;
  for (const auto& by_name : scene.waypoints) waypoints.push_back(robot.values(by_name));
  // Here, since they are counted otherwise once there are others between them.
  detail::requireWithinLimits(robot, waypoints);
  return waypoints;
}

}  // namespace

RobotScene loadRobotScene(const std::string& path) {
  const nlohmann::json document = detail::parseJsonFile(path);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  StrictObject root(document, path);
  if (root.has("description")) root.text("description");
  RobotScene scene;
  readRobot(root.object("robot"), folder, scene);
  for (StrictObject& obstacle : root.objects("obstacles")) {
    scene.obstacles.push_back(readObstacle(std::move(obstacle), folder));
  }
  if (scene.obstacles.empty()) root.fail("obstacles", "there are none");
  readStates(root, scene);
  for (const RobotScene::PlacedObstacle& obstacle : scene.obstacles) {
    const std::size_t states = obstacle.over_time.size();
    if (states == 0 || states == scene.waypoints.size()) continue;
    root.fail("obstacles", obstacle.name + " has " + std::to_string(states) +
                               " states over time, " + "for " +
                               std::to_string(scene.waypoints.size()) + " waypoints");
  }
  if (root.has("errors")) scene.errors = readErrors(root);
  if (root.has("between")) scene.between = readBetween(root);
  if (root.has("largest_step")) {
    scene.largest_step = root.number("largest_step");
    if (!(*scene.largest_step > 0.0)) root.fail("largest_step", "must be > 0");
  }
  // A planner asks for thousands of states, and those that are hard to decide are not needed.
  if (scene.plan) scene.request.max_cells = kCellsOfPlannedState;
  if (root.has("request")) {
    scene.request = detail::readRequest(root.object("request"), scene.request);
  }
  root.finish();
  return scene;
}

Robot loadRobot(const RobotScene& scene) {
  Robot robot(scene.urdf, scene.robot);
  for (const RobotScene::CarriedObject& attached : scene.attached) {
    const AttachedObject object{attached.name, attached.link, nullptr, attached.object.pose,
                                attached.touch_links};
    robot = robot.withAttached(withShape(object, attached.object));
  }
  return robot;
}

SelfCollision loadSelfCollision(const RobotScene& scene, const Robot& robot) {
  if (scene.srdf.empty()) return SelfCollision(robot);
  return SelfCollision(robot, loadAllowedPairs(scene.srdf, robot));
}

RobotQuery loadRobotQuery(const RobotScene& scene) {
  const Robot robot = loadRobot(scene);
  std::vector<Obstacle> obstacles;
  for (const RobotScene::PlacedObstacle& obstacle : scene.obstacles) {
    std::vector<ObstacleState> states = obstacle.over_time;
    if (!states.empty() && states.size() != scene.waypoints.size()) {
      throw InvalidRequest("obstacle " + obstacle.name + " has states at " +
                           std::to_string(states.size()) + " waypoints, the motion has " +
                           std::to_string(scene.waypoints.size()));
    }
    if (!states.empty() && scene.largest_step) {
      states = detail::statesAt(states,
                                detail::stepsBetween(valuesOf(scene, robot), *scene.largest_step));
    }
    const Obstacle placed{obstacle.name, nullptr, obstacle.object.pose, obstacle.displacement,
                          std::move(states)};
    obstacles.push_back(withShape(placed, obstacle.object));
  }
  return {robot, std::move(obstacles)};
}

std::vector<Eigen::VectorXd> waypointsOf(const RobotScene& scene, const Robot& robot) {
  const std::vector<Eigen::VectorXd> waypoints = valuesOf(scene, robot);
  return scene.largest_step ? interpolated(waypoints, *scene.largest_step) : waypoints;
}

}  // namespace fcl_prob
