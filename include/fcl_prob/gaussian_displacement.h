// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The random displacement of object A relative to object B.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fcl_prob {

namespace detail {
struct PrincipalAxes;
}

/// The displacement `ε ~ N(mean, covariance)` by which object A is moved, as a translation in the
/// world frame, relative to object B. Metres. The covariance may have rank 0 to 3: along a
/// direction of variance zero A does not move beyond the mean.
///
/// Immutable after construction, so it may be shared between threads.
class GaussianDisplacement {
 public:
  /// No displacement at all: zero mean, zero covariance.
  GaussianDisplacement();

  /// \param mean        metres, world frame
  /// \param covariance  square metres, world frame; symmetric to 1e-9 of its largest entry and
  ///                    positive semidefinite to 1e-12 of it (what rounding leaves of a singular
  ///                    matrix)
  /// \throws InvalidDistribution if either is not finite, or the covariance is not symmetric, has a
  ///         negative eigenvalue or an entry above 1e300; the message holds the offending value.
  ///
  /// Standard deviations keep their relative accuracy also in a graded matrix such as
  /// diag(1, 1e-16, 1e-30). In a rotated one the entries themselves carry rounding of about 1e-16
  /// of the largest, and a variance that is not above it counts as zero: use
  /// fromStandardDeviations() where it is known better.
  GaussianDisplacement(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance);

  /// The same around a mean of zero. \throws InvalidDistribution
  explicit GaussianDisplacement(const Eigen::Matrix3d& covariance);

  /// Standard deviations (metres) along the columns of `axes`' rotation matrix (normalised first).
  /// Keeps the standard deviations exactly, also where their squares underflow.
  /// \throws InvalidDistribution if a number is not finite, the quaternion is zero, or a standard
  ///         deviation is neither 0 nor in [1e-300, 1e150].
  static GaussianDisplacement fromStandardDeviations(
      const Eigen::Vector3d& standard_deviations,
      const Eigen::Quaterniond& axes = Eigen::Quaterniond::Identity(),
      const Eigen::Vector3d& mean = Eigen::Vector3d::Zero());

  /// The displacement of A relative to B when both move independently: mean_a - mean_b, Σ_a + Σ_b.
  /// \throws InvalidDistribution if the difference is not finite or the sum has an entry above
  ///         1e300.
  static GaussianDisplacement fromIndependent(const GaussianDisplacement& of_a,
                                              const GaussianDisplacement& of_b);

  const Eigen::Vector3d& mean() const { return mean_; }
  const Eigen::Matrix3d& covariance() const { return covariance_; }

  /// Standard deviations along axes(), metres, largest first; exactly 0 beyond the rank.
  const Eigen::Vector3d& standardDeviations() const { return standard_deviations_; }

  /// Principal axes as columns (a rotation: determinant +1), world frame, in the order of
  /// standardDeviations().
  const Eigen::Matrix3d& axes() const { return axes_; }

  /// Number of directions in which A moves: 0 to 3. A small standard deviation that came out of an
  /// eigen-decomposition counts as zero only if rounding of the entries could have left it of a
  /// zero.
  int rank() const { return rank_; }

  /// All three standard deviations equal (to 1e-12) and not zero: whitening is a scaling.
  bool isotropic() const;

  /// The same displacement with another mean (metres, world frame).
  /// \throws InvalidDistribution if that is not finite.
  GaussianDisplacement withMean(const Eigen::Vector3d& mean) const;

  /// The same displacement without what moves along the last of the axes that it has: of a rank
  /// less by one (0: of rank 0 it is this one).
  GaussianDisplacement withoutLastAxis() const;

  /// The displacement of B relative to A: the same distribution mirrored, so the mean changes sign.
  GaussianDisplacement reversed() const;

  /// The same displacement seen from a world rotated by `rotation`: that of the mean `R mean` and
  /// the covariance `R Σ Rᵀ`. A matrix R that is a rotation only to 1e-9 is used as it is, so the
  /// standard deviations may change by as much; axes() is a rotation all the same. With one that is
  /// a rotation to rounding they are kept exactly. The rank never changes.
  /// \throws InvalidPose if that is not a rotation to 1e-9.
  GaussianDisplacement rotated(const Eigen::Matrix3d& rotation) const;

 private:
  GaussianDisplacement(const Eigen::Vector3d& mean, const detail::PrincipalAxes& axes,
                       const Eigen::Matrix3d& covariance);

  Eigen::Vector3d mean_;
  Eigen::Matrix3d covariance_;
  Eigen::Vector3d standard_deviations_;
  Eigen::Matrix3d axes_;
  int rank_;
};

}  // namespace fcl_prob
