// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A frame with a pose error, given its rotation.
#pragma once

#include "fcl_prob/pose_error.h"
#include "gaussian/conditional_translation.h"

namespace fcl_prob::detail {

/// What the error does to whatever the frame carries, given z: it is moved by `motion` and then by
/// `displacement`; world frame, metres.
struct ConditionalMotion {
  fcl::Transform3d motion;
  GaussianDisplacement displacement;
};

class MovedFrame {
 public:
  /// \throws InvalidPose
  MovedFrame(const fcl::Transform3d& frame, const PoseError& error, const std::string& name);

  int rank() const { return conditional_.rank(); }
  const ConditionalTranslation& conditional() const { return conditional_; }
  const fcl::Transform3d& frame() const { return frame_; }

  /// Whether the translation is that of the Lie algebra of SE(3).
  bool isExponential() const { return exponential_; }

  /// The same with Q z for z. \param q  orthogonal
  void turn(const Eigen::MatrixXd& q) { conditional_.turn(q); }

  ConditionalMotion at(const Eigen::VectorXd& z) const;

 private:
  fcl::Transform3d frame_;
  bool exponential_;
  ConditionalTranslation conditional_;  ///< axes of the world, about the frame's origin
};

}  // namespace fcl_prob::detail
