// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/robot_scene.h"

#include <algorithm>
#include <filesystem>

#include "base/constants.h"
#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_groups.h"
#include "io/scene_parts.h"
#include "io/strict_json.h"
#include "robot/joint_indices.h"
#include "robot/motion_names.h"
#include "robot/moving_obstacle.h"
#include "robot/obstacle_scene.h"
#include "robot/robot_notes.h"

namespace fcl_prob {
namespace {

using detail::StrictObject;

constexpr std::size_t kCellsOfPlannedState = 2'000;

/// Of a waypoint, beside the names of joints.
constexpr const char* kTime = "time";

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
  scene.urdf = detail::readUrdfOptions(object, folder, scene.robot);
  if (object.has("srdf")) scene.srdf = detail::besideScene(folder, object.text("srdf"));
  if (object.has("attached")) {
    for (StrictObject& attached : object.objects("attached")) {
      scene.attached.push_back(readAttached(std::move(attached), folder));
    }
  }
  if (const auto base = detail::readPose(object, "base")) scene.robot.base = *base;
  object.finish();
}

RobotScene::Plan::State readState(StrictObject& object, const std::string& key) {
  if (object.holdsText(key)) return object.text(key);
  return object.object(key).numbersByName();
}

RobotScene::Plan readPlan(StrictObject object) {
  RobotScene::Plan plan;
  plan.start = readState(object, "start");
  plan.goal = readState(object, "goal");
  if (object.has("joints") && object.oneOf({"joints", "group"}) == "joints") {
    plan.joints = object.texts("joints");
  }
  if (object.has("group")) plan.group = object.text("group");
  for (const char* key : {"start", "goal"}) {
    if (object.holdsText(key) && plan.group.empty()) {
      object.fail(key, "the name of a state needs the group that it is of");
    }
  }
  if (object.has("motion_threshold")) plan.motion_threshold = object.number("motion_threshold");
  if (object.has("seed")) plan.seed = object.count("seed");
  if (object.has("max_states")) plan.max_states = object.count("max_states");
  if (object.has("largest_time_step")) plan.largest_time_step = object.number("largest_time_step");
  if (object.has("start_time")) plan.start_time = object.number("start_time");
  if (object.has("hold")) plan.hold = object.number("hold");
  if (object.has("latest")) plan.latest = object.number("latest");
  if (object.has("velocities")) plan.velocities = object.object("velocities").numbersByName();
  if (object.has("velocity_scale")) plan.velocity_scale = object.number("velocity_scale");
  object.finish();
  return plan;
}

/// One state, several, or two to be planned between.
void readStates(StrictObject& root, RobotScene& scene) {
  const std::string given = root.oneOf({"joints", "waypoints", "plan"});
  if (given == "plan") {
    scene.plan = readPlan(root.object("plan"));
    if (!scene.plan->group.empty() && scene.srdf.empty()) root.fail("robot: srdf", "is missing");
  } else if (given == "joints") {
    scene.waypoints.push_back(root.object("joints").numbersByName());
  } else {
    for (const StrictObject& waypoint : root.objects("waypoints")) {
      scene.waypoints.push_back(waypoint.numbersByName());
    }
    if (scene.waypoints.empty()) root.fail("waypoints", "there are none");
  }
}

/// The upper triangle row by row, as of a pose.
RobotScene::JointError readJointError(StrictObject object) {
  RobotScene::JointError error;
  if (object.oneOf({"sigma", "covariance"}) == "sigma") {
    error.sigma = object.object("sigma").numbersByName();
  } else {
    error.joints = object.texts("joints");
    const auto count = static_cast<Eigen::Index>(error.joints.size());
    const std::vector<double> numbers = object.numbers("covariance");
    if (static_cast<Eigen::Index>(numbers.size()) != count * (count + 1) / 2) {
      object.fail("covariance", "has " + std::to_string(numbers.size()) + " numbers, " +
                                    std::to_string(count) + " joints need " +
                                    std::to_string(count * (count + 1) / 2));
    }
    error.covariance.resize(count, count);
    auto next = numbers.begin();
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = i; j < count; ++j) {
        error.covariance(i, j) = error.covariance(j, i) = *next++;
      }
    }
  }
  object.finish();
  return error;
}

ErrorsOverTime readErrors(StrictObject& root) {
  const auto errors = detail::valueOf(detail::kErrorsOverTime, root.text("errors"));
  if (errors) return *errors;
  root.fail("errors", "none of persistent, independent and any-dependence");
}

BetweenWaypoints readBetween(StrictObject& root) {
  const auto between = detail::valueOf(detail::kBetweenWaypoints, root.text("between"));
  if (!between) root.fail("between", "neither ignored nor swept");
  return *between;
}

/// Times of the waypoints, and of those between them.
std::vector<double> timesOf(const RobotScene& scene, const std::string& obstacle,
                            const std::vector<detail::WaypointStep>& steps) {
  std::vector<double> given;
  for (const auto& by_name : scene.waypoints) {
    const auto time = by_name.find(kTime);
    if (time == by_name.end()) {
      throw InvalidRequest("waypoint " + std::to_string(given.size()) +
                           " has no time, for which obstacle " + obstacle + " is predicted");
    }
    if (!given.empty() && !(time->second > given.back())) {
      throw InvalidRequest("waypoint " + std::to_string(given.size()) + " is at " +
                           detail::numberText(time->second) + " s, the one before at " +
                           detail::numberText(given.back()) + " s: times have to increase");
    }
    given.push_back(time->second);
  }
  std::vector<double> times;
  for (const detail::WaypointStep& step : steps) times.push_back(detail::timeOf(step, given));
  return times;
}

std::vector<Eigen::VectorXd> valuesOf(const RobotScene& scene, const Robot& robot) {
  std::vector<Eigen::VectorXd> waypoints;
  for (auto by_name : scene.waypoints) {
    by_name.erase(kTime);
    waypoints.push_back(robot.values(by_name));
  }
  // Here, since they are counted otherwise once there are others between them.
  detail::requireWithinLimits(robot, waypoints);
  return waypoints;
}

/// At every step of the waypoints; where there are none, with a plan, as it is.
Obstacle loadPredicted(const RobotScene& scene, const Robot& robot,
                       const RobotScene::PlacedObstacle& placed) {
  Obstacle obstacle = detail::loadObstacle(placed, placed.over_time);
  detail::requireTimes(obstacle);
  if (scene.waypoints.empty()) return obstacle;
  const double step = scene.largest_step.value_or(detail::kInfinity);
  std::vector<ObstacleState> states;
  for (const double time :
       timesOf(scene, placed.name, detail::stepsBetween(valuesOf(scene, robot), step))) {
    states.push_back(detail::predictedAt(obstacle, time));
  }
  obstacle.over_time = std::move(states);
  return obstacle;
}

/// The group of the SRDF that the plan names. \throws InvalidRequest if nothing of it moves
RobotGroup plannedGroup(const RobotScene& scene, const Robot& robot) {
  const RobotGroups groups = loadGroups(scene.srdf, robot);
  const auto group = groups.find(scene.plan->group);
  if (group != groups.end() && !group->second.joints.empty()) return group->second;
  throw InvalidRequest(scene.srdf + ": no group " + scene.plan->group +
                       " with joints that move by themselves");
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
    scene.obstacles.push_back(detail::readObstacle(std::move(obstacle), folder));
  }
  if (scene.obstacles.empty()) root.fail("obstacles", "there are none");
  if (root.has("allowed")) {
    for (StrictObject& allowed : root.objects("allowed")) {
      scene.allowed.push_back({allowed.text("body"), allowed.text("obstacle")});
      allowed.finish();
    }
  }
  readStates(root, scene);
  if (root.has("joint_error")) scene.joint_error = readJointError(root.object("joint_error"));
  if (root.has("base_error")) scene.base_error = detail::readPoseError(root.object("base_error"));
  for (const RobotScene::PlacedObstacle& obstacle : scene.obstacles) {
    const std::size_t states = obstacle.over_time.size();
    if (states == 0 || states == scene.waypoints.size() ||
        detail::isPredicted(obstacle.over_time)) {
      continue;
    }
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
    robot = robot.withAttached(detail::withShape(object, attached.object));
  }
  return robot;
}

SelfCollision loadSelfCollision(const RobotScene& scene, const Robot& robot) {
  if (scene.srdf.empty()) return SelfCollision(robot);
  return SelfCollision(robot, loadAllowedPairs(scene.srdf, robot));
}

std::vector<std::string> plannedJoints(const RobotScene& scene, const Robot& robot) {
  const RobotScene::Plan& plan = scene.plan.value();
  return plan.group.empty() ? plan.joints : plannedGroup(scene, robot).joints;
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> plannedEnds(const RobotScene& scene,
                                                        const Robot& robot) {
  const RobotScene::Plan& plan = scene.plan.value();
  const RobotGroup group = plan.group.empty() ? RobotGroup() : plannedGroup(scene, robot);
  const auto valuesOf = [&](const RobotScene::Plan::State& state) {
    if (const auto* by_name = std::get_if<0>(&state)) return robot.values(*by_name);
    const std::string& name = std::get<std::string>(state);
    const auto found = group.states.find(name);
    if (found != group.states.end()) return robot.values(found->second);
    throw InvalidRequest(scene.srdf + ": group " + plan.group + " has no state " + name);
  };
  return {valuesOf(plan.start), valuesOf(plan.goal)};
}

bool isPredicted(const RobotScene& scene) {
  return std::any_of(scene.obstacles.begin(), scene.obstacles.end(),
                     [](const auto& obstacle) { return detail::isPredicted(obstacle.over_time); });
}

RobotQuery loadRobotQuery(const RobotScene& scene) {
  const Robot robot = loadRobot(scene);
  std::vector<Obstacle> obstacles;
  for (const RobotScene::PlacedObstacle& obstacle : scene.obstacles) {
    if (detail::isPredicted(obstacle.over_time)) {
      obstacles.push_back(loadPredicted(scene, robot, obstacle));
      continue;
    }
    if (!obstacle.over_time.empty() && obstacle.over_time.size() != scene.waypoints.size()) {
      throw InvalidRequest("obstacle " + obstacle.name + " has states at " +
                           std::to_string(obstacle.over_time.size()) +
                           " waypoints, the motion has " + std::to_string(scene.waypoints.size()));
    }
    std::vector<ObstacleState> states = obstacle.over_time;
    if (!states.empty() && scene.largest_step) {
      states = detail::statesAt(states,
                                detail::stepsBetween(valuesOf(scene, robot), *scene.largest_step));
    }
    obstacles.push_back(detail::loadObstacle(obstacle, states));
  }
  return {robot, std::move(obstacles), scene.allowed};
}

RobotErrors errorsOf(const RobotScene& scene, const Robot& robot) {
  RobotErrors errors;
  errors.base = scene.base_error;
  if (!scene.joint_error) return errors;
  errors.joints = jointCovariance(robot, scene.joint_error->sigma);
  const auto at = detail::jointIndices(robot, scene.joint_error->joints);
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = 0; j < at.size(); ++j) {
      errors.joints(at[i], at[j]) =
          scene.joint_error->covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  return errors;
}

void requireExactRobot(const RobotScene& scene, const std::string& what) {
  if (!scene.joint_error && !scene.base_error) return;
  throw InvalidRequest(what + " is not to be had with joint_error or base_error");
}

std::vector<Eigen::VectorXd> waypointsOf(const RobotScene& scene, const Robot& robot) {
  const std::vector<Eigen::VectorXd> waypoints = valuesOf(scene, robot);
  return scene.largest_step ? interpolated(waypoints, *scene.largest_step) : waypoints;
}

}  // namespace fcl_prob
