// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "planning/timed_states.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "planning/moving_joints.h"
#include "robot/joint_indices.h"

namespace fcl_prob::detail {
namespace {

/// Of a velocity, next to which steps are rounded.
constexpr double kVelocityRounding = 1e-9;

Eigen::VectorXd velocitiesOf(const Robot& robot, const TimedPlanningRequest& request) {
  Eigen::VectorXd velocities(static_cast<Eigen::Index>(robot.joints().size()));
  for (const auto& [name, velocity] : request.velocities) {
    jointIndex(robot, name);
    if (velocity > 0.0 && std::isfinite(velocity)) continue;
    throw InvalidRequest("the velocity of joint " + name + " must be > 0 and finite, is " +
                         numberText(velocity));
  }
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const RobotJoint& joint = robot.joints()[i];
    const auto given = request.velocities.find(joint.name);
    const double velocity = given == request.velocities.end() ? joint.velocity : given->second;
    velocities[static_cast<Eigen::Index>(i)] = request.velocity_scale * velocity;
  }
  for (const Eigen::Index i : movingJoints(robot, request.planning.joints)) {
    if (velocities[i] > 0.0) continue;
    throw InvalidRequest("joint " + robot.joints()[static_cast<std::size_t>(i)].name +
                         " has no velocity in its URDF: a plan in time needs one");
  }
  return velocities;
}

}  // namespace

TimedStates::TimedStates(const Robot& robot, const TimedPlanningRequest& request, double end)
    : unit_(request.planning.largest_step / request.largest_time_step),
      start_time_(request.start_time),
      end_(end),
      velocities_(velocitiesOf(robot, request)) {}

Eigen::VectorXd TimedStates::at(double time, const Eigen::VectorXd& values) const {
  Eigen::VectorXd state(values.size() + 1);
  state << values, (time - start_time_) * unit_;
  return state;
}

double TimedStates::soonest(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
  double seconds = 0.0;
  for (Eigen::Index i = 0; i < velocities_.size(); ++i) {
    const double way = std::abs(to[i] - from[i]);
    if (way > 0.0) seconds = std::max(seconds, way / velocities_[i]);
  }
  return seconds;
}

bool TimedStates::isForwardInTime(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
  const double seconds = timeOf(to) - timeOf(from);
  return seconds > 0.0 && soonest(from, to) <= seconds * (1.0 + kVelocityRounding);
}

}  // namespace fcl_prob::detail
