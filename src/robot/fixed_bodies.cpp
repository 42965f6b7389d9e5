// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/fixed_bodies.h"

#include <algorithm>

#include "robot/obstacle_answer.h"

namespace fcl_prob::detail {
namespace {

/// Of the threshold, and of P: how closely it is found out what fixed bodies touch. States closer
/// than that to the threshold are asked one by one.
constexpr double kCloseness = 0.05;

}  // namespace

FixedBodies::FixedBodies(const RobotAmongObstacles& among, const Eigen::VectorXd& values,
                         const std::vector<Eigen::Index>& moving)
    : among_(among), poses_(among.robot().poses(values)), is_fixed_(poses_.size(), true) {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    for (const CarryingJoint& one : among.robot().carryingJoints(i, values)) {
      const auto joint = static_cast<Eigen::Index>(one.joint);
      if (std::find(moving.begin(), moving.end(), joint) != moving.end()) is_fixed_[i] = false;
    }
  }
}

bool FixedBodies::areAmong(const std::vector<fcl::Transform3d>& poses) const {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (is_fixed_[i] && poses[i].matrix() != poses_[i].matrix()) return false;
  }
  return std::find(is_fixed_.begin(), is_fixed_.end(), true) != is_fixed_.end();
}

std::optional<std::vector<Bounds>> FixedBodies::bounds(const ProbabilityRequest& request) const {
  const Question question{*request.threshold, request.contact, request.max_cells};
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = known_.find(question);
  if (known != known_.end()) return known->second;
  ProbabilityRequest closely = request;
  closely.method = ProbabilityMethod::interval;
  closely.threshold.reset();
  closely.relative_tolerance = kCloseness;
  closely.absolute_tolerance = kCloseness * *request.threshold;
  if (request.on_progress) {
    closely.on_progress = [&request](ProbabilityProgress progress) {
      progress.interval.upper = 1.0;  // what moves may touch, too
      return request.on_progress(progress);
    };
  }
  std::vector<Bounds> none(among_.obstacles().size(), Bounds{0.0, 1.0});
  const RobotResult found =
      anyOfAsked(std::move(none), closely, [&](std::size_t i, const ProbabilityRequest& of_one) {
        std::vector<PlacedBody> bodies = among_.placed(i, poses_);
        const auto moves = [this](const PlacedBody& body) { return !is_fixed_[body.body]; };
        bodies.erase(std::remove_if(bodies.begin(), bodies.end(), moves), bodies.end());
        FarBodies far;
        return among_.ask(i, bodies, of_one, far);
      });
  if (found.status == ProbabilityStatus::time_limit ||
      found.status == ProbabilityStatus::cancelled) {
    return std::nullopt;
  }
  std::vector<Bounds> bounds;
  for (const ProbabilityResult& part : found.parts) {
    bounds.push_back({part.lower.value_or(0.0), part.upper.value_or(1.0)});
  }
  return known_[question] = std::move(bounds);
}

}  // namespace fcl_prob::detail
