// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/linear_errors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/quantiles.h"

namespace fcl_prob::detail {
namespace {

/// More than what poses, axes, square roots of matrices and the sums below are rounded by, and than
/// what a base may be off a rotation (1e-9), relative to what they are made of.
constexpr double kRounded = 1e-8;

/// Of the largest deviation: what a square root misses where the variance is next to nothing.
constexpr double kRootRounded = 1e-6;

/// S with S Sᵀ = `covariance`, a column for every direction in which it varies.
Eigen::MatrixXd rootOf(const Eigen::MatrixXd& covariance) {
  if (covariance.size() == 0) return Eigen::MatrixXd(covariance.rows(), 0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  const Eigen::VectorXd roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const Eigen::Index rank = (roots.array() > 0.0).count();
  return (1.0 + kRounded) * solver.eigenvectors().rightCols(rank) * roots.tail(rank).asDiagonal();
}

double largestSingularValue(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) return 0.0;
  const Eigen::MatrixXd square = matrix * matrix.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(square, Eigen::EigenvaluesOnly);
  return (1.0 + kRounded) * std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

/// The joints that carry a body, and what their errors do to it.
class CarriedBody {
 public:
  /// \param root    of the covariance of all joints
  /// \param within  |z|
  CarriedBody(const std::vector<CarryingJoint>& joints, const Ball& ball,
              const Eigen::MatrixXd& root, double within)
      : joints_(joints),
        ball_(ball),
        errors_(static_cast<Eigen::Index>(joints.size()), root.cols()) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      errors_.row(static_cast<Eigen::Index>(j)) =
          joints[j].factor * root.row(static_cast<Eigen::Index>(joints[j].joint));
    }
    changes_ = within * errors_.rowwise().norm();
    findLevers();
    findTurns(within);
  }

  Eigen::Vector3d shiftOf(std::size_t j) const {
    const CarryingJoint& joint = joints_[j];
    return joint.turns ? joint.axis.cross(ball_.centre - joint.point).eval() : joint.axis;
  }

  void addTo(LinearErrors::OfBody& body) const {
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const auto row = errors_.row(static_cast<Eigen::Index>(j));
      body.shift.leftCols(errors_.cols()) += shiftOf(j) * row;
      if (joints_[j].turns) body.turn.leftCols(errors_.cols()) += joints_[j].axis * row;
    }
  }

  /// Half the largest acceleration of a point on the way to any of the values: it is a sum over
  /// pairs of joints of at most the product of both errors and the lever of the outer one.
  double offTheLine() const { return 0.5 * lever_ * turned_ * turned_ + turned_ * slid_; }

  /// What the numbers that positions are made of are rounded by.
  double rounding() const {
    double size = ball_.centre.norm() + ball_.radius;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      size += joints_[j].point.norm() + changes_[static_cast<Eigen::Index>(j)] * lever_;
    }
    const double lost = kRootRounded * changes_.norm() * (lever_ + 1.0);
    return kRounded * size + lost * static_cast<double>(joints_.size());
  }

 private:
  // From the outermost joint inwards: how far points are from an axis changes only by what the
  // joints beyond it do.
  void findLevers() {
    double moved = 0.0;
    for (std::size_t j = joints_.size(); j-- > 0;) {
      const CarryingJoint& joint = joints_[j];
      const double change = changes_[static_cast<Eigen::Index>(j)];
      double lever = 1.0;
      if (joint.turns) {
        lever = joint.axis.cross(ball_.centre - joint.point).norm() + ball_.radius + moved;
        lever_ = std::max(lever_, (1.0 + kRounded) * lever);
      }
      moved += change * lever;
    }
  }

  // The sum of m errors is at most √m times their length.
  void findTurns(double within) {
    Eigen::MatrixXd turning(errors_.rows(), errors_.cols());
    Eigen::Index count = 0;
    double sum = 0.0;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(j);
      if (!joints_[j].turns) {
        slid_ += changes_[row];
        continue;
      }
      turning.row(count++) = errors_.row(row);
      sum += changes_[row];
    }
    const double longest = within * largestSingularValue(turning.topRows(count));
    turned_ = std::min(sum, std::sqrt(static_cast<double>(count)) * longest);
  }

  const std::vector<CarryingJoint>& joints_;
  const Ball ball_;
  Eigen::MatrixXd errors_;   ///< of the joints, by z
  Eigen::VectorXd changes_;  ///< the largest of each
  double lever_ = 0.0;       ///< no point is farther from the axis of a joint, metres
  double turned_ = 0.0;      ///< the sum of all turns is no more, radians
  double slid_ = 0.0;        ///< of all shifts, metres
};

/// The base moves after the joints have: about its expected place, or the world's origin.
class MovedBase {
 public:
  MovedBase(const PoseError& error, const fcl::Transform3d& expected)
      : error_(error.inWorldFrame(expected)), root_(rootOf(error_.covariance())) {
    if (error_.convention() != PoseConvention::world_exponential) centre_ = expected.translation();
  }

  Eigen::Index dimension() const { return root_.cols(); }

  void keepWithin(double within) {
    turn_ = error_.mean().tail<3>().norm() + within * root_.bottomRows(3).norm();
    shift_ = error_.mean().head<3>().norm() + within * root_.topRows(3).norm();
  }

  /// \param radius  of the body
  /// \param moved   by what the joints move its points at most
  void addTo(double radius, double moved, LinearErrors::OfBody& body) const {
    const Eigen::Vector3d arm = body.centre - centre_;
    for (Eigen::Index k = 0; k < root_.cols(); ++k) {
      const Eigen::Vector3d turn = root_.col(k).tail<3>();
      const Eigen::Index column = body.shift.cols() - root_.cols() + k;
      body.shift.col(column) += root_.col(k).head<3>() + turn.cross(arm);
      body.turn.col(column) += turn;
    }
    const double lever = arm.norm() + radius + moved;
    // What is not linear in the turn, what the mean does, and the turn of what the joints moved; an
    // exponential bends the shift by half the turn besides.
    const double mean = error_.mean().head<3>().norm() + error_.mean().tail<3>().norm() * lever;
    body.reach += 0.5 * turn_ * turn_ * lever + mean + turn_ * (moved + 0.5 * shift_);
  }

 private:
  PoseError error_;
  Eigen::MatrixXd root_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  double turn_ = 0.0, shift_ = 0.0;  ///< at most
};

}  // namespace

LinearErrors::LinearErrors(const Robot& robot, const std::vector<Ball>& balls,
                           const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance,
                           const std::optional<PoseError>& base, double chance) {
  const Eigen::MatrixXd root = rootOf(covariance);
  std::optional<MovedBase> moved_base;
  if (base) moved_base.emplace(*base, robot.linkPose(robot.links()[0].name, values));
  const Eigen::Index dimension = root.cols() + (moved_base ? moved_base->dimension() : 0);
  if (dimension > 0) {
    const double half = 0.5 * static_cast<double>(dimension);
    within_ = std::sqrt(2.0 * gammaQInverse(half, chance));
    chance_ = (1.0 + kRounded) * gammaQ(half, 0.5 * within_ * within_);
  }
  if (moved_base) moved_base->keepWithin(within_);
  const std::vector<fcl::Transform3d> poses = robot.poses(values);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Ball ball = balls[i].placed(poses[i]);
    const std::vector<CarryingJoint> joints = robot.carryingJoints(i, values);
    const CarriedBody carried(joints, ball, root, within_);
    OfBody body;
    body.centre = ball.centre;
    body.shift = body.turn = Eigen::Matrix3Xd::Zero(3, dimension);
    carried.addTo(body);
    body.reach = carried.offTheLine() + carried.rounding();
    if (moved_base) {
      const double moved = within_ * (largestSingularValue(body.shift) +
                                      largestSingularValue(body.turn) * ball.radius) +
                           body.reach;
      moved_base->addTo(ball.radius, moved, body);
    }
    body.reach *= 1.0 + kRounded;
    body.most_turn = within_ * largestSingularValue(body.turn);
    body.most_shift = within_ * largestSingularValue(body.shift);
    bodies_.push_back(std::move(body));
  }
}

}  // namespace fcl_prob::detail
