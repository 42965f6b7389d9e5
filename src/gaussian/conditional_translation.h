// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A pose error as a random rotation and, given that, a Gaussian translation.
#pragma once

#include <Eigen/Core>

#include "fcl_prob/pose_error.h"

namespace fcl_prob::detail {

/// (t, θ) ~ N(μ, Σ) as θ = μ_θ + F z and, given z, t ~ N(μ_t + C z, S), where z is standard normal
/// in as many dimensions as the rotation varies in: C = Σ_tθ F⁺ᵀ and S = Σ_tt - C Cᵀ
/// (Σ_tt - Σ_tθ Σ_θθ⁺ Σ_θt). In the frame of the error's convention.
class ConditionalTranslation {
 public:
  explicit ConditionalTranslation(const PoseError& error);

  int rank() const { return static_cast<int>(factor_.cols()); }

  /// F: radians, one column a coordinate of z, the largest standard deviation first and orthogonal
  /// to each other unless they have been turned.
  const Eigen::Matrix<double, 3, Eigen::Dynamic>& rotationFactor() const { return factor_; }

  /// C: metres.
  const Eigen::Matrix<double, 3, Eigen::Dynamic>& slope() const { return slope_; }

  /// The same with Q z for z. \param q  orthogonal
  void turn(const Eigen::MatrixXd& q);

  Eigen::Vector3d rotationVector(const Eigen::VectorXd& z) const;

  /// N(μ_t + C z, S), metres.
  GaussianDisplacement translation(const Eigen::VectorXd& z) const;

 private:
  Eigen::Vector3d mean_rotation_;
  Eigen::Matrix<double, 3, Eigen::Dynamic> factor_;
  Eigen::Matrix<double, 3, Eigen::Dynamic> slope_;
  GaussianDisplacement residual_;  ///< mean μ_t
};

}  // namespace fcl_prob::detail
