// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/robot_scene.h"

#include <filesystem>

#include "io/quantities.h"
#include "io/scene_parts.h"
#include "io/strict_json.h"

namespace fcl_prob {
namespace {

using detail::StrictObject;

std::string besideScene(const std::filesystem::path& folder, const std::string& path) {
  return (folder / path).lexically_normal().string();
}

void readRobot(StrictObject object, const std::filesystem::path& folder, RobotScene& scene) {
  scene.urdf = besideScene(folder, object.text("urdf"));
  if (object.has("packages")) {
    for (const auto& [name, path] : object.object("packages").textsByName()) {
      scene.robot.packages[name] = besideScene(folder, path);
    }
  }
  if (object.has("links")) scene.robot.links = object.texts("links");
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

RobotScene::PlacedObstacle readObstacle(StrictObject object, const std::filesystem::path& folder) {
  RobotScene::PlacedObstacle obstacle;
  obstacle.name = object.text("name");
  obstacle.object = detail::readShapeAndPose(object, folder);
  obstacle.displacement = detail::readDisplacement(object.object("displacement"));
  object.finish();
  return obstacle;
}

ErrorsOverTime readErrors(StrictObject& root) {
  const std::string errors = root.text("errors");
  if (errors == "persistent") return ErrorsOverTime::persistent;
  if (errors == "independent") return ErrorsOverTime::independent;
  root.fail("errors", "neither persistent nor independent");
}

BetweenWaypoints readBetween(StrictObject& root) {
  const std::string between = root.text("between");
  if (between == "ignored") return BetweenWaypoints::ignored;
  if (between != "swept") root.fail("between", "neither ignored nor swept");
  return BetweenWaypoints::swept;
}

std::shared_ptr<const fcl::CollisionGeometryd> geometryOf(const SceneObject& object) {
  if (const auto* primitive = std::get_if<PrimitiveShape>(&object.shape)) return *primitive;
  const MeshFile& mesh = std::get<MeshFile>(object.shape);
  return buildModel<fcl::OBBRSSd>(loadMeshIsolated(mesh.path, mesh.options));
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
  if (root.oneOf({"joints", "waypoints"}) == "joints") {
    scene.waypoints.push_back(root.object("joints").numbersByName());
  } else {
    for (const StrictObject& waypoint : root.objects("waypoints")) {
      scene.waypoints.push_back(waypoint.numbersByName());
    }
    if (scene.waypoints.empty()) root.fail("waypoints", "there are none");
  }
  if (root.has("errors")) scene.errors = readErrors(root);
  if (root.has("between")) scene.between = readBetween(root);
  if (root.has("largest_step")) {
    scene.largest_step = root.number("largest_step");
    if (!(*scene.largest_step > 0.0)) root.fail("largest_step", "must be > 0");
  }
  if (root.has("request")) scene.request = detail::readRequest(root.object("request"));
  root.finish();
  return scene;
}

RobotQuery loadRobotQuery(const RobotScene& scene) {
  std::vector<Obstacle> obstacles;
  for (const RobotScene::PlacedObstacle& obstacle : scene.obstacles) {
    obstacles.push_back(
        {obstacle.name, geometryOf(obstacle.object), obstacle.object.pose, obstacle.displacement});
  }
  return {Robot(scene.urdf, scene.robot), std::move(obstacles)};
}

std::vector<Eigen::VectorXd> waypointsOf(const RobotScene& scene, const Robot& robot) {
  std::vector<Eigen::VectorXd> waypoints;
  for (const auto& by_name : scene.waypoints) waypoints.push_back(robot.values(by_name));
  return scene.largest_step ? interpolated(waypoints, *scene.largest_step) : waypoints;
}

}  // namespace fcl_prob
