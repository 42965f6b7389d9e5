// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/symmetric_axes.h"

namespace fcl_prob::detail {

Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> symmetricAxes(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix);
}

Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> symmetricAxes(
    const Eigen::Matrix<double, 6, 6>& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(matrix);
}

}  // namespace fcl_prob::detail
