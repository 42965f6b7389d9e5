// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Principal axes of a covariance to high relative accuracy, by Jacobi rotations.
//
// Demmel and Veselic, "Jacobi's method is more accurate than QR" (1992): with the stopping rule
// |a_ij| <= eps sqrt(a_ii a_jj), small eigenvalues of a graded positive definite matrix keep their
// relative accuracy. A tridiagonal QR iteration loses them below eps times the largest.
#pragma once

#include <Eigen/Core>

namespace fcl_prob::detail {

struct PrincipalAxes {
  Eigen::Vector3d standard_deviations;  ///< largest first, exactly 0 beyond the rank
  Eigen::Matrix3d axes;                 ///< columns, in that order; determinant +1
  int rank = 0;
  double least_eigenvalue =
      0.0;  ///< of a covariance, before rounding was taken out; may be negative
};

/// Of a symmetric, finite matrix. An eigenvalue that is not larger than what rounding of the
/// entries may leave of a zero counts as zero.
PrincipalAxes principalAxesOfCovariance(const Eigen::Matrix3d& covariance);

/// Of `factor factorᵀ`, without forming it: squaring would lose what is below 1e-8 of the largest.
PrincipalAxes principalAxesOfFactor(const Eigen::Matrix<double, 3, 6>& factor);

/// Of Σ σ_k² a_k a_kᵀ where the axes a_k are orthonormal only to about 1e-9. Keeps the rank, and
/// every standard deviation its relative accuracy.
PrincipalAxes principalAxesOfOblique(Eigen::Vector3d standard_deviations, Eigen::Matrix3d axes);

/// Standard deviations along given orthonormal axes, put in order. Keeps every one, however small.
PrincipalAxes orderedAxes(const Eigen::Vector3d& standard_deviations, const Eigen::Matrix3d& axes);

}  // namespace fcl_prob::detail
