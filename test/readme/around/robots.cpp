// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// docs/robots.md, run where my_robot.urdf is.
#include <fcl/geometry/shape/cylinder.h>

#include <cstdio>

#include "fcl_prob/robot_query.h"

using namespace fcl_prob;

int main() {
  const auto mug = std::make_shared<fcl::Cylinderd>(0.04, 0.1);
  fcl::Transform3d mug_pose = fcl::Transform3d::Identity();
  mug_pose.translation() = Eigen::Vector3d(0.25, 0.0, 0.25);
  ProbabilityRequest request;
  request.relative_tolerance = 0.2;
  const std::vector<Eigen::VectorXd> waypoints = {Eigen::VectorXd::Zero(6),
                                                  Eigen::VectorXd::Constant(6, 0.01)};
#include "robots_1.inc"
  std::printf("state %.3g to %.3g, motion %.3g to %.3g\n", state.any.lower, state.any.upper,
              motion.any.lower, motion.any.upper);
  return state.any.upper > state.any.lower && motion.any.upper > motion.any.lower ? 0 : 1;
}
