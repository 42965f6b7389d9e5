// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/body_sweep.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// More than what poses, axes and the sums below are rounded by, and than what a base may be off a
// rotation (1e-9), relative to the lengths that they
// are made of.
constexpr double kRoundedKinematics = 1e-8;

/// What one joint does in a step.
struct JointShare {
  double change;   ///< |change of its value| to either side
  double off;      ///< of that: what is not along the line of the step
  double lever;    ///< of a turning one no point is farther from its axis; else 1
  double rounded;  ///< what its value may be off
  bool turns;
};

double distanceFromAxis(const Eigen::Vector3d& x, const CarryingJoint& joint) {
  return joint.axis.cross(x - joint.point).norm();
}

// From the outermost joint inwards: how far the points are from an axis changes only by what the
// joints beyond it do.
std::vector<JointShare> sharesOf(const std::vector<CarryingJoint>& joints, const Ball& body,
                                 const JointStep& step) {
  std::vector<JointShare> shares(joints.size());
  double moved = 0.0;
  for (std::size_t j = joints.size(); j-- > 0;) {
    const CarryingJoint& joint = joints[j];
    const auto k = static_cast<Eigen::Index>(joint.joint);
    const double off = std::fabs(joint.factor) * step.off[k];
    const double change = std::fabs(joint.factor * step.half[k]) + off;
    const double value =
        std::fabs(joint.factor) * (step.sizes[k] + std::fabs(step.half[k]) + step.off[k]) +
        std::fabs(joint.offset);
    const double lever =
        joint.turns ? distanceFromAxis(body.centre, joint) + body.radius + moved : 1.0;
    shares[j] = {change, off, (1.0 + kRoundedKinematics) * lever, 8 * kEpsilon * value,
                 joint.turns};
    moved += change * shares[j].lever;
  }
  return shares;
}

// Half of the largest |d²x/ds²| on the way to any of the values, and what joints do across the
// line.
double offTheLine(const std::vector<JointShare>& shares) {
  double sum = 0.0;
  double turned = 0.0;  // by the joints closer to the root
  for (const JointShare& share : shares) {
    const double own = share.turns ? share.change : 0.0;
    sum += 0.5 * share.change * share.lever * (own + 2.0 * turned) + share.off * share.lever;
    turned += own;
  }
  return sum;
}

}  // namespace

BodySweep sweepOf(const Robot& robot, std::size_t body, const fcl::Transform3d& middle,
                  const Ball& ball, const JointStep& step) {
  BodySweep sweep;
  sweep.middle = middle;
  const Ball placed = ball.placed(middle);
  sweep.around = placed;
  sweep.motion.centre = placed.centre;
  const auto joints = robot.carryingJoints(body, step.middle);
  const std::vector<JointShare> shares = sharesOf(joints, placed, step);
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double size = placed.centre.norm() + placed.radius;
  double rounded = 0.0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const CarryingJoint& joint = joints[j];
    const double change = joint.factor * step.half[static_cast<Eigen::Index>(joint.joint)];
    sweep.reach += shares[j].change * shares[j].lever;
    rounded += shares[j].rounded * shares[j].lever;
    size += joint.point.norm() + shares[j].change * shares[j].lever;
    if (joint.turns) turn += change * joint.axis;
    shift += change * (joint.turns ? joint.axis.cross(placed.centre - joint.point) : joint.axis);
  }
  if (!(sweep.reach > 0.0)) return sweep;
  rounded += kRoundedKinematics * size;
  sweep.reach = (1.0 + kRoundedKinematics) * sweep.reach + rounded;
  sweep.around.radius += sweep.reach;
  sweep.motion.turns = {turn};
  sweep.motion.shifts = {shift};
  sweep.motion.ball = (1.0 + kRoundedKinematics) * offTheLine(shares) + rounded;
  return sweep;
}

}  // namespace fcl_prob::detail
