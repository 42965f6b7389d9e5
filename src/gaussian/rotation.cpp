// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/rotation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/pose_error.h"

namespace fcl_prob {
namespace detail {
namespace {

constexpr double kRotationTolerance = 1e-9;
constexpr double kTurn = 6.2831853071795872;  // 2 pi, rounded up

// Below it the terms that the series leave out are below 1e-18.
constexpr double kSmallAngle = 1e-4;

// sin(x)/x, (1 - cos x)/x² and (x - sin x)/x³.
struct SinusRatios {
  double first;
  double second;
  double third;
};

SinusRatios sinusRatios(double x) {
  if (x < kSmallAngle) return {1.0 - x * x / 6.0, 0.5 - x * x / 24.0, 1.0 / 6.0 - x * x / 120.0};
  const double half = std::sin(0.5 * x) / x;
  // Without cancellation where x is small, too: the first term that is left out is below 1e-17.
  const double x2 = x * x;
  const double third =
      x < 0.3
          ? 1.0 / 6.0 -
                x2 / 120.0 *
                    (1.0 - x2 / 42.0 * (1.0 - x2 / 72.0 * (1.0 - x2 / 110.0 * (1.0 - x2 / 156.0))))
          : (x - std::sin(x)) / (x * x * x);
  return {std::sin(x) / x, 2.0 * half * half, third};
}

}  // namespace

void requireRotation(const Eigen::Matrix3d& rotation) {
  const double defect =
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(defect <= kRotationTolerance)) {
    throw InvalidPose("matrix is not a rotation: R Rᵀ differs from the identity by " +
                      numberText(defect));
  }
  if (rotation.determinant() < 0) {
    throw InvalidPose("matrix is a reflection, not a rotation: determinant " +
                      numberText(rotation.determinant()));
  }
}

Eigen::Matrix3d rotationOfAngles(const Eigen::Vector3d& roll_pitch_yaw, const std::string& name) {
  for (const double angle : roll_pitch_yaw) {
    if (!(std::abs(angle) <= kTurn)) {
      throw InvalidPose(name + ": an angle of " + numberText(angle) +
                        " radians is more than a turn");
    }
  }
  const auto about = [&](int axis) {
    return Eigen::AngleAxisd(roll_pitch_yaw[axis], Eigen::Vector3d::Unit(axis));
  };
  return (about(2) * about(1) * about(0)).toRotationMatrix();
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

Eigen::Matrix3d translationJacobian(const Eigen::Vector3d& rotation_vector) {
  const SinusRatios ratios = sinusRatios(rotation_vector.norm());
  const Eigen::Matrix3d cross = crossMatrix(rotation_vector);
  return Eigen::Matrix3d::Identity() + ratios.second * cross + ratios.third * cross * cross;
}

}  // namespace detail

Eigen::Matrix3d rotationOf(const Eigen::Vector3d& rotation_vector) {
  const detail::SinusRatios ratios = detail::sinusRatios(rotation_vector.norm());
  const Eigen::Matrix3d cross = detail::crossMatrix(rotation_vector);
  return Eigen::Matrix3d::Identity() + ratios.first * cross + ratios.second * cross * cross;
}

}  // namespace fcl_prob
