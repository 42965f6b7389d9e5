// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A user of the installed robot part.
#include <fcl/geometry/shape/sphere.h>
#include <fcl_prob/robot_query.h>

#include <iostream>

int main(int argc, char* argv[]) {
  if (argc != 2) return 2;
  const fcl_prob::Robot robot(argv[1]);
  fcl_prob::Obstacle ball{"ball", std::make_shared<fcl::Sphered>(0.1)};
  ball.displacement = fcl_prob::GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  const fcl_prob::RobotQuery query(robot, {ball});
  const fcl_prob::RobotResult result = query.state(robot.values({}), {});
  std::cout << robot.bodies().size() << " bodies, P in [" << result.any.lower << ", "
            << result.any.upper << "]\n";
  return result.any.lower > 0.0 ? 0 : 1;
}
