// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Eigenvalues of symmetric matrices, by Eigen's solver, compiled in one place: each file that uses
// it would take seconds for it.
#pragma once

#include <Eigen/Eigenvalues>

namespace fcl_prob::detail {

Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> symmetricAxes(const Eigen::MatrixXd& matrix);

/// Of covariances of poses.
Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> symmetricAxes(
    const Eigen::Matrix<double, 6, 6>& matrix);

}  // namespace fcl_prob::detail
