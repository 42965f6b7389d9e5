// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/prepared_obstacle.h"

#include <algorithm>
#include <memory>

#include "geometry/occupancy.h"

namespace fcl_prob::detail {
namespace {

PreparedGeometries geometriesOf(const Obstacle& obstacle) {
  const std::string name = "obstacle " + obstacle.name;
  PreparedGeometries geometries{std::make_shared<const PreparedGeometry>(obstacle.geometry, name)};
  for (const ObstacleBody& body : obstacle.more) {
    geometries.push_back(std::make_shared<const PreparedGeometry>(body.geometry, name));
  }
  return geometries;
}

}  // namespace

PreparedObstacle::PreparedObstacle(const Obstacle& obstacle)
    : group_(geometriesOf(obstacle), "obstacle " + obstacle.name),
      hulls_(group_.members()),
      in_obstacle_{fcl::Transform3d::Identity()},
      around_(ballAround(*geometries()[0])) {
  for (std::size_t i = 0; i < obstacle.more.size(); ++i) {
    const fcl::Transform3d& pose = obstacle.more[i].in_obstacle;
    validatePose(pose, "obstacle " + obstacle.name + ": body " + std::to_string(i + 1));
    in_obstacle_.push_back(pose);
    around_ = around_.with(ballAround(*geometries()[i + 1]).placed(pose));
  }
}

std::vector<fcl::Transform3d> PreparedObstacle::poses(const fcl::Transform3d& pose) const {
  std::vector<fcl::Transform3d> poses{pose};
  for (std::size_t i = 1; i < in_obstacle_.size(); ++i) poses.push_back(pose * in_obstacle_[i]);
  return poses;
}

bool PreparedObstacle::mayMeet(const fcl::CollisionGeometryd& geometry) const {
  return std::any_of(geometries().begin(), geometries().end(), [&](const auto& body) {
    return !whyNeverInContact(geometry, body->geometry());
  });
}

}  // namespace fcl_prob::detail
