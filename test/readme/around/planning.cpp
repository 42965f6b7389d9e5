// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// docs/planning.md: a plan, and one in time, past a ball that is not far.
#include <fcl/geometry/shape/sphere.h>

#include <cstdio>

#include "fcl_prob/certified_planning.h"
#include "fcl_prob/timed_planning.h"

using namespace fcl_prob;

namespace {

const char* const kArm = R"(<robot name="arm">
  <link name="base"/>
  <link name="upper"><collision><origin xyz="0.2 0 0"/><geometry><box size="0.4 0.06 0.06"/></geometry></collision></link>
  <link name="fore"><collision><origin xyz="0.2 0 0"/><geometry><box size="0.4 0.05 0.05"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="2"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.45 0 0"/>
    <axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="1" velocity="2"/></joint>
</robot>)";

bool plansAmongWhatStays(const Robot& robot, const SelfCollision& self_collision,
                         const Obstacle& ball, const Eigen::VectorXd& start,
                         const Eigen::VectorXd& goal) {
  const RobotQuery query(robot, {ball});
#include "planning_1.inc"
  std::printf("%s, P of the motion below %.3g\n", toString(plan.path.status).c_str(),
              plan.motion.upper);
  return plan.path.waypoints.size() >= 2 && plan.motion.upper < 0.1;
}

bool plansInTime(const Robot& robot, const SelfCollision& self_collision, Obstacle person,
                 const Eigen::VectorXd& start, const Eigen::VectorXd& goal) {
  const fcl::Transform3d pose_now = person.pose;
  fcl::Transform3d pose_later = pose_now;
  pose_later.translation().x() += 2.0;
  const auto error_now = GaussianDisplacement::fromStandardDeviations({0.01, 0.01, 0.01});
  const auto error_later = GaussianDisplacement::fromStandardDeviations({0.08, 0.08, 0.08});
#include "planning_2.inc"
  std::printf("%zu waypoints in time\n", plan.waypoints.size());
  return plan.waypoints.size() >= 2;
}

}  // namespace

int main() {
  const Robot robot = Robot::fromText(kArm);
  const SelfCollision self_collision(robot);
  Obstacle ball{"ball", std::make_shared<fcl::Sphered>(0.1)};
  ball.pose.translation() = Eigen::Vector3d(0.6, 0.2, 0.5);
  ball.displacement = GaussianDisplacement::fromStandardDeviations({0.01, 0.01, 0.01});
  const Eigen::VectorXd start = robot.values({{"turn", -0.3}}),
                        goal = robot.values({{"turn", 0.6}});
  const bool stays = plansAmongWhatStays(robot, self_collision, ball, start, goal);
  return stays && plansInTime(robot, self_collision, ball, start, goal) ? 0 : 1;
}
