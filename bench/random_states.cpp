// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/random_states.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/stopwatch.h"
#include "bench/least_distance.h"
#include "cli/random_displacement.h"
#include "fcl_prob/mesh_io.h"
#include "geometry/geometry_kind.h"

namespace fcl_prob::cli {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

}  // namespace

Robot benchRobot(const std::string& models_folder, const std::string& name) {
  const std::filesystem::path models(models_folder);
  if (name == "KUKA iiwa") return Robot((models / "kuka_iiwa/model.urdf").string());
  RobotOptions options;
  options.packages["fetch_description"] = (models / "fetch_robot/fetch_description").string();
  return Robot((models / "fetch_robot/fetch_description/robots/fetch.urdf").string(), options);
}

Eigen::MatrixXd drawnStates(const Robot& robot, Uniforms& random, int count) {
  Eigen::MatrixXd states(robot.joints().size(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (Eigen::Index i = 0; i < states.rows(); ++i) {
      const RobotJoint& joint = robot.joints()[static_cast<std::size_t>(i)];
      states(i, k) =
          random.between(std::max(joint.lower, -kHalfTurn), std::min(joint.upper, kHalfTurn));
    }
  }
  return states;
}

Geometry personMesh(const std::string& models_folder) {
  const std::filesystem::path models(models_folder);
  return buildTree(loadMeshIsolated((models / "human/human_man_4980.obj").string()), "obbrss");
}

Geometry canMesh(const std::string& models_folder) {
  const std::filesystem::path models(models_folder);
  return buildTree(loadMeshIsolated((models / "objects/coke_can_500.obj").string()), "obbrss");
}

std::vector<Obstacle> cansAround(const Geometry& mesh, Uniforms& random, int count) {
  std::vector<Obstacle> cans;
  for (int i = 0; i < count; ++i) {
    const double direction = random.between(-kHalfTurn, kHalfTurn);
    const double distance = random.between(0.3, 0.9), height = random.between(0.0, 1.0);
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() =
        Eigen::Vector3d(distance * std::cos(direction), distance * std::sin(direction), height);
    pose.linear() = random.rotation();
    cans.push_back({"can " + std::to_string(i), mesh, pose, randomError(random, 0.01, 0.05)});
  }
  return cans;
}

double msOfSamples(const RobotQuery& query, const std::vector<fcl::Transform3d>& poses,
                   std::uint64_t samples) {
  std::vector<Whitening> whitenings;
  for (const Obstacle& obstacle : query.obstacles()) {
    whitenings.emplace_back(std::get<GaussianDisplacement>(obstacle.displacement));
  }
  const detail::Stopwatch watch;
  for (std::uint64_t i = 0; i < samples; ++i) {
    for (std::size_t k = 0; k < whitenings.size(); ++k) {
      const Obstacle& obstacle = query.obstacles()[k];
      fcl::Transform3d pose = obstacle.pose;
      pose.translation() += randomDisplacement(whitenings[k], 1, i);
      if (touchesAny(query.robot(), poses, *obstacle.geometry, pose)) break;
    }
  }
  return watch.milliseconds();
}

std::vector<Geometry> paddedBodies(const Robot& robot, double padding) {
  std::vector<Geometry> bodies;
  for (const RobotBody& body : robot.bodies()) {
    const bool is_mesh = detail::kindOf(*body.geometry) == detail::GeometryKind::mesh;
    bodies.push_back(is_mesh ? padded(*body.geometry, padding) : body.geometry);
  }
  return bodies;
}

Obstacle personBeside(const Geometry& mesh, Uniforms& random) {
  const double direction = random.between(-kHalfTurn, kHalfTurn),
               distance = random.between(0.4, 1.0);
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = distance * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0.0);
  pose.rotate(Eigen::AngleAxisd(random.between(-kHalfTurn, kHalfTurn), Eigen::Vector3d::UnitZ()));
  pose.rotate(Eigen::AngleAxisd(0.5 * kHalfTurn, Eigen::Vector3d::UnitX()));
  return {"person", mesh, pose, randomError(random, 0.01, 0.05)};
}

}  // namespace fcl_prob::cli
