// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// From whitened points to displacements, without rounding.
#pragma once

#include <memory>

#include "fcl_prob/whitening.h"
#include "oracle/oracle.h"

namespace oracle {

class WhitenedFrame {
 public:
  WhitenedFrame(const fcl_prob::Whitening& whitening,
                const fcl_prob::GaussianDisplacement& displacement);

  int rank() const { return rank_; }

  /// The displacement that is whitened to y.
  Displacement displacement(const Eigen::Vector3d& y) const;

  /// The same, rounded to doubles.
  Eigen::Vector3d rounded(const Eigen::Vector3d& y) const;

  /// The largest |(W A)(W A)ᵀ - I|.
  double error() const { return error_; }

 private:
  struct Exact {
    ExactVector mean;
    std::array<ExactVector, 3> columns;  ///< displacement by which y_k grows by 1
  };

  WideVector roundedWide(const Eigen::Vector3d& y) const;

  int rank_;
  std::shared_ptr<const Exact> exact_;
  WideVector mean_;
  std::array<WideVector, 3> columns_;
  double error_ = 0.0;
};

}  // namespace oracle
