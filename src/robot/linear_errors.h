// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What errors of joints and base do to the bodies of a robot, to first order.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fcl_prob/pose_error.h"
#include "fcl_prob/robot.h"
#include "robot/body_balls.h"

namespace fcl_prob::detail {

/// All errors are made of z ~ N(0, I). For |z| <= within() a point of a body that is expected at x
/// is at x + shift z + (turn z) × (x - centre), but for `reach`: the error of a first-order
/// expansion of the kinematics is half the largest acceleration of a point while the joints move
/// along a line (body_sweep.h), and an ellipsoid of joint errors moves no more of them far at once.
class LinearErrors {
 public:
  struct OfBody {
    Eigen::Vector3d centre;   ///< metres, world frame
    Eigen::Matrix3Xd shift;   ///< metres
    Eigen::Matrix3Xd turn;    ///< radians
    double reach = 0.0;       ///< metres, rounded upwards
    double most_turn = 0.0;   ///< |turn z| is no more, radians
    double most_shift = 0.0;  ///< |shift z| is no more, metres
  };

  /// \param balls       around the bodies, each in its own frame
  /// \param covariance  of the joints, a valid one
  /// \param chance      that |z| is larger than within(): what is wanted, in (0, 1)
  LinearErrors(const Robot& robot, const std::vector<Ball>& balls, const Eigen::VectorXd& values,
               const Eigen::MatrixXd& covariance, const std::optional<PoseError>& base,
               double chance);

  const OfBody& of(std::size_t body) const { return bodies_[body]; }

  double within() const { return within_; }

  /// Certainly not below the chance that |z| is larger.
  double chance() const { return chance_; }

  /// No point of a body is farther from where it is expected, metres, while |z| <= within().
  double farthest(std::size_t body, double radius) const {
    const OfBody& of = bodies_[body];
    return of.most_shift + of.most_turn * radius + of.reach;
  }

 private:
  std::vector<OfBody> bodies_;
  double within_ = 0.0;
  double chance_ = 0.0;
};

}  // namespace fcl_prob::detail
