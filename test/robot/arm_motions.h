// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The shipped arm among obstacles, and what counting finds of its motions.
#pragma once

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include "arm_cases.h"
#include "catch.h"
#include "fcl_prob/robot_query.h"

namespace fcl_prob_test {

inline fcl::Transform3d at(double x, double y, double z) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

inline fcl_prob::GaussianDisplacement sigma(double x, double y, double z) {
  return fcl_prob::GaussianDisplacement::fromStandardDeviations({x, y, z});
}

inline std::vector<fcl_prob::Obstacle> ballAndBox() {
  return {
      {"ball", std::make_shared<fcl::Sphered>(0.1), at(0.55, 0.25, 0.35), sigma(0.03, 0.02, 0.04)},
      {"box", std::make_shared<fcl::Boxd>(0.2, 0.3, 0.4), at(0.5, -0.45, 0.2),
       sigma(0.02, 0.05, 0.01)}};
}

inline std::vector<Eigen::VectorXd> sweep(const fcl_prob::Robot& arm, int waypoints) {
  std::vector<Eigen::VectorXd> result;
  for (int i = 0; i < waypoints; ++i) {
    const double t = i / (waypoints - 1.0);
    result.push_back(
        arm.values({{"turn", 0.75 - 1.5 * t}, {"shoulder", 0.15}, {"elbow", 0.3}, {"grip", 0.02}}));
  }
  return result;
}

inline bool touchesAt(const fcl_prob::Robot& robot, const std::vector<fcl::Transform3d>& poses,
                      const fcl::CollisionGeometryd& obstacle, const fcl::Transform3d& pose) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const fcl::CollisionGeometryd& body = *robot.bodies()[i].geometry;
    fcl::CollisionResultd result;
    if (fcl::collide(&body, poses[i], &obstacle, pose, fcl::CollisionRequestd(), result) > 0) {
      return true;
    }
  }
  return false;
}

/// All bodies of the obstacle, at a pose of it.
inline bool touchesAt(const fcl_prob::Robot& robot, const std::vector<fcl::Transform3d>& poses,
                      const fcl_prob::Obstacle& obstacle, const fcl::Transform3d& pose) {
  if (touchesAt(robot, poses, *obstacle.geometry, pose)) return true;
  for (const fcl_prob::ObstacleBody& body : obstacle.more) {
    if (touchesAt(robot, poses, *body.geometry, pose * body.in_obstacle)) return true;
  }
  return false;
}

inline bool touches(const fcl_prob::Robot& robot, const Eigen::VectorXd& values,
                    const fcl_prob::Obstacle& obstacle, const Eigen::Vector3d& moved) {
  fcl::Transform3d pose = obstacle.pose;
  pose.translation() += moved;
  return touchesAt(robot, robot.poses(values), obstacle, pose);
}

/// How often any of the waypoints touches, errors drawn once, in so many draws.
inline double counted(const fcl_prob::RobotQuery& query,
                      const std::vector<Eigen::VectorXd>& waypoints, int draws, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<std::vector<fcl::Transform3d>> poses;
  for (const Eigen::VectorXd& values : waypoints) poses.push_back(query.robot().poses(values));
  int hits = 0;
  for (int i = 0; i < draws; ++i) {
    bool hit = false;
    for (const fcl_prob::Obstacle& obstacle : query.obstacles()) {
      const auto& displacement = std::get<fcl_prob::GaussianDisplacement>(obstacle.displacement);
      Eigen::Vector3d y;
      for (int k = 0; k < 3; ++k) y[k] = normal(random) * displacement.standardDeviations()[k];
      fcl::Transform3d pose = obstacle.pose;
      pose.translation() += displacement.mean() + displacement.axes() * y;
      for (std::size_t k = 0; k < poses.size() && !hit; ++k) {
        hit = touchesAt(query.robot(), poses[k], obstacle, pose);
      }
    }
    hits += hit;
  }
  return static_cast<double>(hits) / draws;
}

inline void checkCounted(const fcl_prob::Bounds& bounds, double counted, int draws) {
  const double error = 5.0 * std::sqrt(bounds.upper * (1.0 - bounds.lower) / draws) + 5.0 / draws;
  CAPTURE(bounds.lower, bounds.upper, counted);
  CHECK(bounds.lower <= counted + error);
  CHECK(bounds.upper >= counted - error);
}

inline fcl_prob::ProbabilityRequest withTolerance(double relative) {
  fcl_prob::ProbabilityRequest request;
  request.relative_tolerance = relative;
  return request;
}

inline bool overlap(const fcl_prob::Bounds& x, const fcl_prob::Bounds& y) {
  return x.lower <= y.upper && y.lower <= x.upper;
}

}  // namespace fcl_prob_test
