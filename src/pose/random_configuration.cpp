// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/random_configuration.h"

#include <cmath>
#include <string>

#include "base/number_text.h"
#include "base/symmetric_axes.h"
#include "fcl_prob/exceptions.h"
#include "geometry/validation.h"
#include "pose/moved_frame.h"

namespace fcl_prob {
namespace {

using detail::numberText;
using Poses = std::vector<fcl::Transform3d>;

constexpr double kSymmetryTolerance = 1e-9;
constexpr double kDefinitenessTolerance = 1e-12;

// Eigenvalues of a correlation matrix below this are what rounding leaves of zero.
constexpr double kZeroEigenvalue = 1e-14;

Poses moved(const Poses& poses, const fcl::Transform3d& motion) {
  Poses result;
  result.reserve(poses.size());
  for (const fcl::Transform3d& pose : poses) result.push_back(motion * pose);
  return result;
}

// What is left of both, to the last bit if one of them does not move.
GaussianDisplacement difference(const GaussianDisplacement& of_a,
                                const GaussianDisplacement& of_b) {
  if (of_b.rank() == 0) return of_a.withMean(of_a.mean() - of_b.mean());
  if (of_a.rank() == 0) return of_b.reversed().withMean(of_a.mean() - of_b.mean());
  return GaussianDisplacement::fromIndependent(of_a, of_b);
}

void requireJoints(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance) {
  if (covariance.rows() != mean.size() || covariance.cols() != mean.size()) {
    throw InvalidDistribution("joint covariance is " + std::to_string(covariance.rows()) + " x " +
                              std::to_string(covariance.cols()) + " for " +
                              std::to_string(mean.size()) + " joints");
  }
  if (!mean.allFinite() || !covariance.allFinite()) {
    throw InvalidDistribution("mean or covariance of the joints is not finite");
  }
  for (Eigen::Index row = 0; row < mean.size(); ++row) {
    if (covariance(row, row) < 0.0) {
      throw InvalidDistribution("variance of joint " + std::to_string(row) +
                                " is negative: " + numberText(covariance(row, row)));
    }
    for (Eigen::Index column = 0; column < row; ++column) {
      const double upper = covariance(column, row);
      const double lower = covariance(row, column);
      const double scale = std::sqrt(covariance(row, row) * std::abs(covariance(column, column)));
      if (std::abs(upper - lower) <= kSymmetryTolerance * scale) continue;
      throw InvalidDistribution("joint covariance is not symmetric: " + numberText(upper) +
                                " and " + numberText(lower) + " for joints " +
                                std::to_string(column) + " and " + std::to_string(row));
    }
  }
}

// F with F Fᵀ = covariance and as many columns as its rank, found from the correlations: joints may
// be of different units.
Eigen::MatrixXd factorOf(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd scales = covariance.diagonal().cwiseSqrt();
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Zero(covariance.rows(), covariance.cols());
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j < covariance.cols(); ++j) {
      const double entry = 0.5 * covariance(i, j) + 0.5 * covariance(j, i);
      if (scales[i] > 0.0 && scales[j] > 0.0) correlation(i, j) = entry / scales[i] / scales[j];
    }
  }
  if (covariance.rows() == 0) return correlation;
  const auto solver = detail::symmetricAxes(correlation);
  const Eigen::VectorXd& values = solver.eigenvalues();
  const double tolerance = kDefinitenessTolerance * static_cast<double>(covariance.rows());
  if (values.minCoeff() < -tolerance) {
    throw InvalidDistribution("joint covariance has a negative eigenvalue: " +
                              numberText(values.minCoeff()) + " as correlation");
  }
  const Eigen::Index rank =
      (values.array() > kZeroEigenvalue * static_cast<double>(covariance.rows())).count();
  return scales.asDiagonal() * solver.eigenvectors().rightCols(rank).rowwise().reverse() *
         values.tail(rank).reverse().cwiseSqrt().asDiagonal();
}

}  // namespace

struct RandomPoses::Side {
  Poses members;
  detail::MovedFrame frame;

  Side(Body&& body, const std::string& name)
      : members(std::move(body.members)), frame(body.frame, body.error, "the frame of " + name) {
    for (const fcl::Transform3d& pose : members) detail::validatePose(pose, "a member of " + name);
  }
};

RandomPoses::RandomPoses(Body a, Body b)
    : a_(std::make_shared<const Side>(std::move(a), "A")),
      b_(std::make_shared<const Side>(std::move(b), "B")) {}

RandomPoses::~RandomPoses() = default;

RandomPoses RandomPoses::ofOne(const fcl::Transform3d& pose_a, const PoseError& error,
                               const fcl::Transform3d& pose_b) {
  return {Body{{pose_a}, pose_a, error}, Body{{pose_b}, pose_b, PoseError()}};
}

int RandomPoses::dimension() const { return a_->frame.rank() + b_->frame.rank(); }

PlacedConfiguration RandomPoses::at(const Eigen::VectorXd& z) const {
  const auto of_a = a_->frame.at(z.head(a_->frame.rank()));
  const auto of_b = b_->frame.at(z.tail(b_->frame.rank()));
  return {moved(a_->members, of_a.motion), moved(b_->members, of_b.motion),
          difference(of_a.displacement, of_b.displacement)};
}

RandomJoints::RandomJoints(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance,
                           ForwardKinematics kinematics, Poses poses_b,
                           const GaussianDisplacement& displacement)
    : mean_(mean),
      kinematics_(std::move(kinematics)),
      poses_b_(std::move(poses_b)),
      displacement_(displacement) {
  requireJoints(mean, covariance);
  factor_ = factorOf(covariance);
}

PlacedConfiguration RandomJoints::at(const Eigen::VectorXd& z) const {
  const Eigen::VectorXd values = dimension() == 0 ? mean_ : Eigen::VectorXd(mean_ + factor_ * z);
  return {kinematics_(values), poses_b_, displacement_};
}

struct RandomBase::Base {
  detail::MovedFrame frame;
};

RandomBase::RandomBase(std::shared_ptr<const RandomConfiguration> carried,
                       const fcl::Transform3d& base, const PoseError& error)
    : carried_(std::move(carried)),
      base_(std::make_shared<const Base>(Base{detail::MovedFrame(base, error, "the base")})) {}

RandomBase::~RandomBase() = default;

int RandomBase::dimension() const { return base_->frame.rank() + carried_->dimension(); }

PlacedConfiguration RandomBase::at(const Eigen::VectorXd& z) const {
  const auto of_base = base_->frame.at(z.head(base_->frame.rank()));
  PlacedConfiguration placed = carried_->at(z.tail(carried_->dimension()));
  placed.poses_a = moved(placed.poses_a, of_base.motion);
  // The displacement of the rest is that of obstacles in the world frame: the base does not turn
  // it.
  placed.displacement = difference(of_base.displacement, placed.displacement.reversed());
  return placed;
}

}  // namespace fcl_prob
