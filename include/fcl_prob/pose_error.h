// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The random error of a pose: translation and rotation, six degrees of freedom.
#pragma once

#include <fcl/common/types.h>

#include <Eigen/Core>
#include <array>
#include <optional>

#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob {

/// What the six numbers (t, θ) of an error do to a pose (R, p). exp(θ) is the rotation by |θ|
/// radians about θ, Exp the exponential of SE(3): Exp(t, θ) = (exp(θ), V(θ) t).
enum class PoseConvention {
  world_rotation_vector,  ///< (exp(θ) R, p + t): both in the world frame, about the pose's origin
  body_rotation_vector,   ///< (R exp(θ), p + R t): both in the body's own frame
  world_exponential,      ///< Exp(t, θ) (R, p): turns about the world's origin
  body_exponential        ///< (R, p) Exp(t, θ)
};

/// An error ξ = (x, y, z, rx, ry, rz) ~ N(mean, covariance) of a pose: metres and radians, in the
/// frame and with the meaning that the convention names. The covariance may have any rank from 0
/// to 6.
///
/// Immutable after construction, so it may be shared between threads.
class PoseError {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// No error at all.
  PoseError();

  /// \param covariance  order x, y, z, rx, ry, rz; square metres, metres·radians, square radians.
  ///                    Symmetric to 1e-9 and positive semidefinite to 1e-12, relative to the
  ///                    largest entries of the blocks of translations and of rotations.
  /// \param mean        metres and radians
  /// \throws InvalidDistribution if either is not finite, or the covariance is not symmetric, has a
  ///         negative eigenvalue or an entry above 1e300; if a standard deviation or the mean of
  ///         the rotation is above π radians, as degrees would be; the message holds the offending
  ///         value.
  explicit PoseError(const Matrix6& covariance,
                     PoseConvention convention = PoseConvention::world_rotation_vector,
                     const Vector6& mean = Vector6::Zero());

  /// Independent standard deviations along the axes of the convention's frame: metres; radians.
  /// Those of the translation are kept exactly. \throws InvalidDistribution
  static PoseError fromStandardDeviations(
      const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation,
      PoseConvention convention = PoseConvention::world_rotation_vector);

  /// A translation and, independent of it, a rotation vector (square radians; zero mean), both in
  /// the convention's frame. With a covariance of 0 for the rotation every query gives what it
  /// gives for the displacement alone. \throws InvalidDistribution
  static PoseError fromIndependent(
      const GaussianDisplacement& translation, const Eigen::Matrix3d& rotation_covariance,
      PoseConvention convention = PoseConvention::world_rotation_vector);

  /// From the covariance of geometry_msgs/PoseWithCovariance: rows of x, y, z, roll, pitch, yaw
  /// about the fixed axes of the message's frame, which must be the world frame here, and through
  /// the pose's origin: PoseConvention::world_rotation_vector. Small angles are taken for a
  /// rotation vector, which they are up to their squares. \throws InvalidDistribution
  static PoseError fromRosCovariance(const Matrix6& covariance);
  /// The message's own array, row by row. \throws InvalidDistribution
  static PoseError fromRosCovariance(const std::array<double, 36>& covariance);

  /// The error of A's pose relative to B, which stays, from independent errors of both: to first
  /// order in the rotations. (RandomPoses gives what is exact.) In the world frame.
  /// \throws InvalidDistribution, InvalidPose
  static PoseError betweenBodies(const PoseError& of_a, const fcl::Transform3d& pose_a,
                                 const PoseError& of_b, const fcl::Transform3d& pose_b);

  const Vector6& mean() const { return mean_; }
  const Matrix6& covariance() const { return covariance_; }
  PoseConvention convention() const { return convention_; }

  /// Number of independent directions in which the rotation varies: 0 to 3.
  int rotationRank() const { return rotation_rank_; }

  /// The same error of the body at `pose`, with both in the world frame: exact, and of the same
  /// kind (rotation vector or exponential). \throws InvalidPose
  PoseError inWorldFrame(const fcl::Transform3d& pose) const;

  /// The coordinates of the same error in another frame, and about another point: Ad ξ, where
  /// `to_new` maps coordinates of the old frame to the new ones. Of an exponential in the world
  /// frame that is exact (Exp(Ad_T ξ) = T Exp(ξ) T⁻¹); of a rotation vector it is so if only the
  /// frame is turned, and of first order in the rotation if the point moves. \throws InvalidPose
  PoseError transformed(const fcl::Transform3d& to_new) const;

  /// The translation by itself, in the convention's frame.
  GaussianDisplacement translation() const;

 private:
  PoseError mapped(const Matrix6& map, PoseConvention convention) const;

  Vector6 mean_;
  Matrix6 covariance_;
  PoseConvention convention_;
  int rotation_rank_ = 0;
  std::optional<GaussianDisplacement> independent_translation_;
};

/// The rotation by |θ| radians about `rotation_vector`.
Eigen::Matrix3d rotationOf(const Eigen::Vector3d& rotation_vector);

/// What `error` makes of `pose` (world frame, metres) where it takes the value (x, y, z, rx, ry,
/// rz).
fcl::Transform3d displacedPose(const fcl::Transform3d& pose, PoseConvention convention,
                               const PoseError::Vector6& error);

}  // namespace fcl_prob
