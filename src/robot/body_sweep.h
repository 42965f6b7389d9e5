// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where the points of a body are while the joints move from one state to another.
#pragma once

#include "fcl_prob/robot.h"
#include "robot/body_balls.h"
#include "scene/point_motion.h"

namespace fcl_prob::detail {

/// Joint values middle + s * half + r, s from -1 to 1 and |r| <= off, joint by joint.
struct JointStep {
  Eigen::VectorXd middle;
  Eigen::VectorXd half;
  Eigen::VectorXd sizes;  ///< of the numbers that the middle was made of: what it is rounded by
  Eigen::VectorXd off;    ///< >= 0
};

/// All that a body does in a step. A point of it is always within `reach` of where it is in the
/// middle, and more closely where `motion` says: along s times its velocity there, and off that by
/// no more than half the largest acceleration and what the joints are off their line. (For a chain
/// of joints the acceleration is the sum of a_i × (a_j × (x - p_j)) over all pairs of them, j the
/// one farther out, so that the lever arms bound it.)
struct BodySweep {
  fcl::Transform3d middle;  ///< pose of the body, world frame, metres
  PointMotion motion;
  double reach = 0.0;  ///< metres, rounded upwards; 0 if no joint that carries it moves
  Ball around;         ///< around all of the body at all times of the step, world frame
};

/// \param body    index
/// \param middle  pose of that body at step.middle
/// \param ball    around the body, in its own frame
BodySweep sweepOf(const Robot& robot, std::size_t body, const fcl::Transform3d& middle,
                  const Ball& ball, const JointStep& step);

}  // namespace fcl_prob::detail
