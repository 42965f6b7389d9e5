// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/moved_frame.h"

#include "gaussian/rotation.h"
#include "geometry/validation.h"

namespace fcl_prob::detail {
namespace {

const fcl::Transform3d& validated(const fcl::Transform3d& pose, const std::string& name) {
  validatePose(pose, name);
  return pose;
}

// M ε for ε ~ `displacement`.
GaussianDisplacement mapped(const GaussianDisplacement& displacement, const Eigen::Matrix3d& map) {
  const Eigen::Matrix3d factor =
      map * displacement.axes() * displacement.standardDeviations().asDiagonal();
  const Eigen::Matrix3d covariance = factor * factor.transpose();
  return {map * displacement.mean(), covariance};
}

}  // namespace

MovedFrame::MovedFrame(const fcl::Transform3d& frame, const PoseError& error,
                       const std::string& name)
    : frame_(validated(frame, name)),
      convention_(error.inWorldFrame(frame).convention()),
      conditional_(error.inWorldFrame(frame)) {}

ConditionalMotion MovedFrame::at(const Eigen::VectorXd& z) const {
  const Eigen::Vector3d theta = conditional_.rotationVector(z);
  const GaussianDisplacement translation = conditional_.translation(z);
  ConditionalMotion result{fcl::Transform3d::Identity(), translation};
  result.motion.linear() = rotationOf(theta);
  if (convention_ == PoseConvention::world_exponential) {
    result.displacement = mapped(translation, translationJacobian(theta));
    return result;
  }
  const Eigen::Vector3d origin = frame_.translation();
  result.motion.translation() = origin - result.motion.linear() * origin;
  return result;
}

}  // namespace fcl_prob::detail
