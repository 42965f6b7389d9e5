// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What teams ask in place of a probability: how far a robot is from an obstacle, or whether they
// touch.
#pragma once

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "fcl_prob/robot_query.h"

namespace fcl_prob::cli {

/// The least distance of any body from the obstacle where it is expected, metres; no more than
/// `least`: what is farther need not be known. 0 or below: they touch.
inline double leastDistance(const Robot& robot, const std::vector<fcl::Transform3d>& poses,
                            const Obstacle& obstacle, double least) {
  for (std::size_t i = 0; i < poses.size() && least > 0.0; ++i) {
    fcl::DistanceResultd result;
    result.min_distance = least;
    fcl::distance(robot.bodies()[i].geometry.get(), poses[i], obstacle.geometry.get(),
                  obstacle.pose, fcl::DistanceRequestd(), result);
    least = std::min(least, result.min_distance);
  }
  return least;
}

/// Whether any of the bodies touches the geometry at the pose; the first that does ends it.
/// \param body_at  of an index: an fcl::CollisionGeometryd
template <typename BodyAt>
bool touchesAny(const BodyAt& body_at, const std::vector<fcl::Transform3d>& poses,
                const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    fcl::CollisionResultd result;
    if (fcl::collide(&body_at(i), poses[i], &geometry, pose, fcl::CollisionRequestd(), result) >
        0) {
      return true;
    }
  }
  return false;
}

inline bool touchesAny(const std::vector<std::shared_ptr<const fcl::CollisionGeometryd>>& bodies,
                       const std::vector<fcl::Transform3d>& poses,
                       const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose) {
  return touchesAny(
      [&](std::size_t i) -> const auto& { return *bodies[i]; }, poses, geometry, pose);
}

inline bool touchesAny(const Robot& robot, const std::vector<fcl::Transform3d>& poses,
                       const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose) {
  return touchesAny(
      [&](std::size_t i) -> const auto& { return *robot.bodies()[i].geometry; }, poses, geometry,
      pose);
}

/// A mesh whose vertices are moved outwards by so much (metres), as motion planners pad: along the
/// mean of the normals around each.
std::shared_ptr<const fcl::CollisionGeometryd> padded(const fcl::CollisionGeometryd& geometry,
                                                      double padding);

}  // namespace fcl_prob::cli
