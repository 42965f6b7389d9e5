// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where the points of a turning object are, against what a cell of rotations says of them.
#include "pose/rotation_cell.h"

#include <cmath>

#include "catch.h"
#include "mesh_shapes.h"
#include "pose_cases.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;
using namespace fcl_prob_test;

// Without displacements all shifts are left to the motion.
TEST_CASE("points of a cell of rotations are where its motion has them") {
  RandomBodies random(7);
  double tightest = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double sigma = random.logUniform(1e-4, 0.5);
    PoseError::Matrix6 covariance = PoseError::Matrix6::Zero();
    covariance.bottomRightCorner<3, 3>() = sigma * sigma * Eigen::Matrix3d::Identity();
    const MovedFrame frame(random.pose(1.0),
                           PoseError(covariance, static_cast<PoseConvention>(i % 4)), "a");
    RotationCell cell = wholeRotationSpace(3);
    const Eigen::Vector3d middle = random.uniform(0.0, 3.0) * random.direction();
    for (int k = 0; k < 3; ++k) {
      const double half = random.logUniform(1e-2, 1.0);
      cell.lo[k] = middle[k] - half;
      cell.hi[k] = middle[k] + half;
    }
    const Eigen::Vector3d reference = random.uniform(0.0, 1.0) * random.direction();
    const CellMotion motion = motionOf(frame, cell, reference, 4.0, 0.0);
    for (int j = 0; j < 40; ++j) {
      const Eigen::Vector3d point = random.uniform(0.0, 1.0) * random.direction();
      Eigen::VectorXd z(3);
      for (int k = 0; k < 3; ++k) {
        const int where = random.integer(0, 2);
        z[k] = where == 0   ? cell.lo[k]
               : where == 1 ? cell.hi[k]
                            : random.uniform(cell.lo[k], cell.hi[k]);
      }
      const ConditionalMotion at = frame.at(z);
      const Eigen::Vector3d from = motion.turned * point;
      const Eigen::Vector3d moved =
          at.motion * point + at.displacement.mean() - from - motion.displacement.mean();
      const Eigen::Vector3d n = random.direction();
      const double bound = motion.motion.along(n, from);
      CAPTURE(i, j, sigma, moved.norm(), bound);
      CHECK(std::fabs(n.dot(moved)) <= bound);
      tightest = std::max(tightest, std::fabs(n.dot(moved)) / bound);
    }
  }
  CHECK(tightest > 0.8);
}
