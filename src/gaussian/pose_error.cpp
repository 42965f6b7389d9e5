// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/pose_error.h"

#include <cmath>
#include <string>

#include "base/number_text.h"
#include "base/symmetric_axes.h"
#include "fcl_prob/exceptions.h"
#include "gaussian/covariance_limits.h"
#include "gaussian/principal_axes.h"
#include "gaussian/rotation.h"

namespace fcl_prob {
namespace {

using namespace detail;
using Vector6 = PoseError::Vector6;
using Matrix6 = PoseError::Matrix6;

std::string entryName(int row, int column) {
  static const char* const names[] = {"x", "y", "z", "rx", "ry", "rz"};
  return std::string("pose covariance(") + names[row] + ", " + names[column] + ")";
}

// Metres and radians are not of one size: entries are compared with the largest of their block.
Vector6 scalesOf(const Matrix6& covariance) {
  const double translation = std::sqrt(covariance.topLeftCorner<3, 3>().cwiseAbs().maxCoeff());
  const double rotation = std::sqrt(covariance.bottomRightCorner<3, 3>().cwiseAbs().maxCoeff());
  Vector6 scales;
  scales << Eigen::Vector3d::Constant(translation), Eigen::Vector3d::Constant(rotation);
  return scales;
}

void requireFinite(const Matrix6& covariance) {
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const double entry = covariance(row, column);
      if (std::isfinite(entry) && std::abs(entry) <= kLargestCovariance) continue;
      throw InvalidDistribution(
          entryName(row, column) +
          (std::isfinite(entry) ? " is larger than 1e300: " : " is not finite: ") +
          numberText(entry));
    }
  }
}

void requireSymmetric(const Matrix6& covariance) {
  const Vector6 scales = scalesOf(covariance);
  for (int row = 0; row < 6; ++row) {
    for (int column = row + 1; column < 6; ++column) {
      const double upper = covariance(row, column);
      const double lower = covariance(column, row);
      if (std::abs(upper - lower) <= kSymmetryTolerance * scales[row] * scales[column]) continue;
      throw InvalidDistribution(entryName(row, column) + " is " + numberText(upper) + " but " +
                                entryName(column, row) + " is " + numberText(lower) +
                                ": not symmetric");
    }
  }
}

// The covariance divided by the scales, so that eigenvalues can be compared; a block that is zero
// must have a zero row.
void requireSemidefinite(const Matrix6& covariance) {
  const Vector6 scales = scalesOf(covariance);
  Matrix6 scaled = Matrix6::Zero();
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const double scale = scales[row] * scales[column];
      if (scale > 0.0) {
        scaled(row, column) = covariance(row, column) / scale;
      } else if (covariance(row, column) != 0.0) {
        throw InvalidDistribution(entryName(row, column) + " is " +
                                  numberText(covariance(row, column)) +
                                  " although one of the two does not vary");
      }
    }
  }
  const double least = detail::symmetricAxes(scaled).eigenvalues().minCoeff();
  if (least >= -kDefinitenessTolerance) return;
  throw InvalidDistribution("pose covariance has a negative eigenvalue: " + numberText(least) +
                            " of its largest entries");
}

void requireRadians(const Matrix6& covariance, const Vector6& mean) {
  for (int axis = 3; axis < 6; ++axis) {
    const double deviation = std::sqrt(std::max(0.0, covariance(axis, axis)));
    if (deviation <= M_PI) continue;
    throw InvalidDistribution("standard deviation of the rotation is " + numberText(deviation) +
                              " radians, above pi: degrees?");
  }
  const double angle = mean.tail<3>().norm();
  if (angle <= M_PI) return;
  throw InvalidDistribution("mean rotation is " + numberText(angle) +
                            " radians, above pi: degrees?");
}

const Matrix6& validated(const Matrix6& covariance, const Vector6& mean) {
  requireFinite(covariance);
  if (!mean.allFinite()) {
    throw InvalidDistribution(
        "mean of the pose error is not finite: " + numberText(Eigen::Vector3d(mean.head<3>())) +
        ", " + numberText(Eigen::Vector3d(mean.tail<3>())));
  }
  requireSymmetric(covariance);
  requireSemidefinite(covariance);
  requireRadians(covariance, mean);
  return covariance;
}

void requirePose(const fcl::Transform3d& pose) {
  detail::requireRotation(pose.linear());
  if (!pose.translation().allFinite()) {
    throw InvalidPose("translation is not finite: " +
                      numberText(Eigen::Vector3d(pose.translation())));
  }
}

Matrix6 turning(const Eigen::Matrix3d& rotation) {
  Matrix6 map = Matrix6::Zero();
  map.topLeftCorner<3, 3>() = rotation;
  map.bottomRightCorner<3, 3>() = rotation;
  return map;
}

// Ad_T in the order (translation, rotation).
Matrix6 adjoint(const fcl::Transform3d& pose) {
  Matrix6 map = turning(pose.linear());
  map.topRightCorner<3, 3>() = detail::crossMatrix(pose.translation()) * pose.linear();
  return map;
}

bool isExponential(PoseConvention convention) {
  return convention == PoseConvention::world_exponential ||
         convention == PoseConvention::body_exponential;
}

bool isInWorld(PoseConvention convention) {
  return convention == PoseConvention::world_exponential ||
         convention == PoseConvention::world_rotation_vector;
}

}  // namespace

PoseError::PoseError()
    : mean_(Vector6::Zero()),
      covariance_(Matrix6::Zero()),
      convention_(PoseConvention::world_rotation_vector) {}

PoseError::PoseError(const Matrix6& covariance, PoseConvention convention, const Vector6& mean)
    : mean_(mean), covariance_(validated(covariance, mean)), convention_(convention) {
  covariance_ = (0.5 * covariance + 0.5 * covariance.transpose()).eval();
  rotation_rank_ = detail::principalAxesOfCovariance(covariance_.bottomRightCorner<3, 3>()).rank;
}

PoseError PoseError::fromStandardDeviations(const Eigen::Vector3d& translation,
                                            const Eigen::Vector3d& rotation,
                                            PoseConvention convention) {
  for (const double value : rotation) {
    if (std::isfinite(value) && value >= 0.0) continue;
    throw InvalidDistribution("standard deviation of the rotation is not finite and >= 0: " +
                              numberText(value));
  }
  return fromIndependent(GaussianDisplacement::fromStandardDeviations(translation),
                         rotation.cwiseAbs2().asDiagonal().toDenseMatrix(), convention);
}

PoseError PoseError::fromIndependent(const GaussianDisplacement& translation,
                                     const Eigen::Matrix3d& rotation_covariance,
                                     PoseConvention convention) {
  Matrix6 covariance = Matrix6::Zero();
  covariance.topLeftCorner<3, 3>() = translation.covariance();
  covariance.bottomRightCorner<3, 3>() = rotation_covariance;
  Vector6 mean = Vector6::Zero();
  mean.head<3>() = translation.mean();
  PoseError error(covariance, convention, mean);
  error.independent_translation_ = translation;
  return error;
}

PoseError PoseError::fromRosCovariance(const Matrix6& covariance) {
  return PoseError(covariance, PoseConvention::world_rotation_vector);
}

PoseError PoseError::fromRosCovariance(const std::array<double, 36>& covariance) {
  using RowMajor = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  return fromRosCovariance(Matrix6(Eigen::Map<const RowMajor>(covariance.data())));
}

PoseError PoseError::mapped(const Matrix6& map, PoseConvention convention) const {
  return PoseError(map * covariance_ * map.transpose(), convention, map * mean_);
}

PoseError PoseError::inWorldFrame(const fcl::Transform3d& pose) const {
  requirePose(pose);
  if (isInWorld(convention_)) return *this;
  if (isExponential(convention_)) return mapped(adjoint(pose), PoseConvention::world_exponential);
  PoseError result = mapped(turning(pose.linear()), PoseConvention::world_rotation_vector);
  if (independent_translation_) {
    result.independent_translation_ = independent_translation_->rotated(pose.linear());
  }
  return result;
}

PoseError PoseError::transformed(const fcl::Transform3d& to_new) const {
  requirePose(to_new);
  return mapped(adjoint(to_new), convention_);
}

PoseError PoseError::betweenBodies(const PoseError& of_a, const fcl::Transform3d& pose_a,
                                   const PoseError& of_b, const fcl::Transform3d& pose_b) {
  // Both as rotation vectors about A's origin, world frame. An exponential there is a rotation
  // vector to first order.
  const auto aboutA = [&](const PoseError& error, const fcl::Transform3d& pose) {
    const PoseError in_world = error.inWorldFrame(pose);
    const bool about_origin = isExponential(in_world.convention());
    fcl::Transform3d shift = fcl::Transform3d::Identity();
    shift.translation() =
        (about_origin ? Eigen::Vector3d::Zero().eval() : Eigen::Vector3d(pose.translation())) -
        pose_a.translation();
    return in_world.transformed(shift);
  };
  const PoseError a = aboutA(of_a, pose_a);
  const PoseError b = aboutA(of_b, pose_b);
  return PoseError(a.covariance() + b.covariance(), PoseConvention::world_rotation_vector,
                   a.mean() - b.mean());
}

GaussianDisplacement PoseError::translation() const {
  if (independent_translation_) return *independent_translation_;
  return {mean_.head<3>(), covariance_.topLeftCorner<3, 3>()};
}

fcl::Transform3d displacedPose(const fcl::Transform3d& pose, PoseConvention convention,
                               const PoseError::Vector6& error) {
  const Eigen::Vector3d t = error.head<3>();
  const Eigen::Vector3d theta = error.tail<3>();
  fcl::Transform3d change = fcl::Transform3d::Identity();
  change.linear() = rotationOf(theta);
  change.translation() =
      isExponential(convention) ? Eigen::Vector3d(detail::translationJacobian(theta) * t) : t;
  if (convention == PoseConvention::world_rotation_vector) {
    fcl::Transform3d displaced = pose;
    displaced.linear() = change.linear() * pose.linear();
    displaced.translation() += t;
    return displaced;
  }
  return convention == PoseConvention::world_exponential ? change * pose : pose * change;
}

}  // namespace fcl_prob
