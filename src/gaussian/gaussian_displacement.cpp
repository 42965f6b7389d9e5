// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/gaussian_displacement.h"

#include <cmath>

#include "base/constants.h"
#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "gaussian/covariance_limits.h"
#include "gaussian/principal_axes.h"
#include "gaussian/rotation.h"

namespace fcl_prob {
namespace {

using namespace detail;

constexpr double kIsotropyTolerance = 1e-12;

// Of products of axes that are inverted by transposing, which all bounds on rounding allow for.
constexpr double kAxesRounding = 8 * detail::kEpsilon;

// Both 1/sigma and sigma² stay finite.
constexpr double kLeastStandardDeviation = 1e-300;
constexpr double kLargestStandardDeviation = 1e150;

std::string entryName(const std::string& matrix, Eigen::Index row, Eigen::Index column) {
  return matrix + "(" + std::to_string(row) + ", " + std::to_string(column) + ")";
}

const Eigen::Vector3d& requireFiniteMean(const Eigen::Vector3d& mean) {
  if (!mean.allFinite()) {
    throw InvalidDistribution("mean displacement is not finite: " + numberText(mean));
  }
  return mean;
}

const Eigen::Matrix3d& requireSymmetric(const Eigen::Matrix3d& covariance) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double entry = covariance(row, column);
      if (!std::isfinite(entry) || std::abs(entry) > kLargestCovariance) {
        throw InvalidDistribution(
            entryName("covariance", row, column) +
            (std::isfinite(entry) ? " is larger than 1e300: " : " is not finite: ") +
            numberText(entry));
      }
    }
  }
  const double tolerance = kSymmetryTolerance * covariance.cwiseAbs().maxCoeff();
  for (int row = 0; row < 3; ++row) {
    for (int column = row + 1; column < 3; ++column) {
      const double upper = covariance(row, column);
      const double lower = covariance(column, row);
      if (std::abs(upper - lower) > tolerance) {
        throw InvalidDistribution("covariance is not symmetric: " + entryName("", row, column) +
                                  " = " + numberText(upper) + ", " + entryName("", column, row) +
                                  " = " + numberText(lower));
      }
    }
  }
  return covariance;
}

Eigen::Matrix3d symmetricPart(const Eigen::Matrix3d& matrix) {
  return 0.5 * matrix + 0.5 * matrix.transpose();
}

detail::PrincipalAxes semidefiniteAxes(const Eigen::Matrix3d& covariance) {
  detail::PrincipalAxes axes = detail::principalAxesOfCovariance(covariance);
  if (axes.least_eigenvalue < -kDefinitenessTolerance * covariance.cwiseAbs().maxCoeff()) {
    throw InvalidDistribution("covariance has a negative eigenvalue: " +
                              numberText(axes.least_eigenvalue));
  }
  return axes;
}

void requireStandardDeviations(const Eigen::Vector3d& standard_deviations) {
  for (const double value : standard_deviations) {
    const bool in_range = value >= kLeastStandardDeviation && value <= kLargestStandardDeviation;
    if (value != 0 && !in_range) {
      throw InvalidDistribution("standard deviation is neither 0 nor in [1e-300, 1e150]: " +
                                numberText(value));
    }
  }
}

Eigen::Matrix3d rotationMatrix(const Eigen::Quaterniond& axes) {
  if (!axes.coeffs().allFinite() || axes.coeffs().isZero(0)) {
    throw InvalidDistribution(
        "quaternion of the standard deviations' axes is not a rotation: w = " +
        numberText(axes.w()) + ", xyz = " + numberText(axes.vec()));
  }
  // Divided first: of denormal coefficients the inverse of the length overflows.
  const Eigen::Vector4d scaled = axes.coeffs() / axes.coeffs().cwiseAbs().maxCoeff();
  return Eigen::Quaterniond(Eigen::Vector4d(scaled.normalized())).toRotationMatrix();
}

Eigen::Matrix3d covarianceOf(const detail::PrincipalAxes& axes) {
  const Eigen::Matrix3d factor = axes.axes * axes.standard_deviations.asDiagonal();
  return symmetricPart(factor * factor.transpose());
}

// Of columns that should be orthonormal.
double orthonormalityDefect(const Eigen::Matrix3d& matrix) {
  return (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

}  // namespace

GaussianDisplacement::GaussianDisplacement()
    : mean_(Eigen::Vector3d::Zero()),
      covariance_(Eigen::Matrix3d::Zero()),
      standard_deviations_(Eigen::Vector3d::Zero()),
      axes_(Eigen::Matrix3d::Identity()),
      rank_(0) {}

GaussianDisplacement::GaussianDisplacement(const Eigen::Vector3d& mean,
                                           const Eigen::Matrix3d& covariance)
    : GaussianDisplacement(requireFiniteMean(mean),
                           semidefiniteAxes(symmetricPart(requireSymmetric(covariance))),
                           symmetricPart(covariance)) {}

GaussianDisplacement::GaussianDisplacement(const Eigen::Matrix3d& covariance)
    : GaussianDisplacement(Eigen::Vector3d::Zero(), covariance) {}

GaussianDisplacement::GaussianDisplacement(const Eigen::Vector3d& mean,
                                           const detail::PrincipalAxes& axes,
                                           const Eigen::Matrix3d& covariance)
    : mean_(requireFiniteMean(mean)),
      covariance_(covariance),
      standard_deviations_(axes.standard_deviations),
      axes_(axes.axes),
      rank_(axes.rank) {}

GaussianDisplacement GaussianDisplacement::fromStandardDeviations(
    const Eigen::Vector3d& standard_deviations, const Eigen::Quaterniond& axes,
    const Eigen::Vector3d& mean) {
  requireStandardDeviations(standard_deviations);
  const detail::PrincipalAxes ordered =
      detail::orderedAxes(standard_deviations, rotationMatrix(axes));
  return {mean, ordered, covarianceOf(ordered)};
}

GaussianDisplacement GaussianDisplacement::fromIndependent(const GaussianDisplacement& of_a,
                                                           const GaussianDisplacement& of_b) {
  Eigen::Matrix<double, 3, 6> factor;
  factor << of_a.axes_ * of_a.standard_deviations_.asDiagonal(),
      of_b.axes_ * of_b.standard_deviations_.asDiagonal();
  const Eigen::Matrix3d covariance = of_a.covariance_ + of_b.covariance_;
  if (!(covariance.array().abs() <= kLargestCovariance).all()) {
    throw InvalidDistribution("sum of the covariances is larger than 1e300: largest entries " +
                              numberText(of_a.covariance_.cwiseAbs().maxCoeff()) + " and " +
                              numberText(of_b.covariance_.cwiseAbs().maxCoeff()));
  }
  return {of_a.mean_ - of_b.mean_, detail::principalAxesOfFactor(factor), covariance};
}

bool GaussianDisplacement::isotropic() const {
  return rank_ == 3 &&
         standard_deviations_[2] >= (1 - kIsotropyTolerance) * standard_deviations_[0];
}

GaussianDisplacement GaussianDisplacement::withMean(const Eigen::Vector3d& mean) const {
  GaussianDisplacement result = *this;
  result.mean_ = requireFiniteMean(mean);
  return result;
}

GaussianDisplacement GaussianDisplacement::withoutLastAxis() const {
  if (rank_ == 0) return *this;
  detail::PrincipalAxes axes{standard_deviations_, axes_, rank_ - 1};
  axes.standard_deviations[rank_ - 1] = 0.0;
  return {mean_, axes, covarianceOf(axes)};
}

GaussianDisplacement GaussianDisplacement::reversed() const { return withMean(-mean_); }

GaussianDisplacement GaussianDisplacement::rotated(const Eigen::Matrix3d& rotation) const {
  detail::requireRotation(rotation);
  const Eigen::Matrix3d covariance = symmetricPart(rotation * covariance_ * rotation.transpose());
  const Eigen::Matrix3d axes = rotation * axes_;
  if (orthonormalityDefect(axes) > kAxesRounding) {
    return {rotation * mean_, detail::principalAxesOfOblique(standard_deviations_, axes),
            covariance};
  }
  GaussianDisplacement result = *this;
  result.mean_ = requireFiniteMean(rotation * mean_);
  result.axes_ = axes;
  result.covariance_ = covariance;
  return result;
}

}  // namespace fcl_prob
