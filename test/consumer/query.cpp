// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A user of the installed library: two boxes, one of them uncertain.
#include <fcl/geometry/shape/box.h>
#include <fcl_prob/fcl_prob.h>

#include <iostream>

int main() {
  const fcl::Boxd box(1, 1, 1);
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation().x() = 1.5;
  const auto displacement =
      fcl_prob::GaussianDisplacement::fromStandardDeviations(Eigen::Vector3d::Constant(0.3));
  fcl_prob::ProbabilityResult result;
  const double p = fcl_prob::collisionProbability(&box, pose, &box, fcl::Transform3d::Identity(),
                                                  displacement, {}, result);
  std::cout << "P = " << p << '\n';
  return p > 0.02 && p < 0.08 ? 0 : 1;
}
