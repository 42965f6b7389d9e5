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

bool movesByExponential(PoseConvention convention) {
  return convention == PoseConvention::world_exponential ||
         convention == PoseConvention::body_exponential;
}

// In the axes of the world and about the frame's own origin, for exponentials, too: the levers of
// rotations are no longer than they must be.
PoseError aboutOrigin(const PoseError& error, const fcl::Transform3d& frame) {
  fcl::Transform3d to_origin = fcl::Transform3d::Identity();
  if (error.convention() == PoseConvention::body_exponential) {
    to_origin.linear() = frame.linear();
  } else if (error.convention() == PoseConvention::world_exponential) {
    to_origin.translation() = -frame.translation();
  } else {
    return error.inWorldFrame(frame);
  }
  return error.transformed(to_origin);
}

}  // namespace

MovedFrame::MovedFrame(const fcl::Transform3d& frame, const PoseError& error,
                       const std::string& name)
    : frame_(validated(frame, name)),
      exponential_(movesByExponential(error.convention())),
      conditional_(aboutOrigin(error, frame)) {}

ConditionalMotion MovedFrame::at(const Eigen::VectorXd& z) const {
  const Eigen::Vector3d theta = conditional_.rotationVector(z);
  const GaussianDisplacement translation = conditional_.translation(z);
  ConditionalMotion result{fcl::Transform3d::Identity(), translation};
  result.motion.linear() = rotationOf(theta);
  if (exponential_) result.displacement = mapped(translation, translationJacobian(theta));
  const Eigen::Vector3d origin = frame_.translation();
  result.motion.translation() = origin - result.motion.linear() * origin;
  return result;
}

}  // namespace fcl_prob::detail
