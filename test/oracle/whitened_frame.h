// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// From whitened points to displacements, as the displacement's law has it.
#pragma once

#include <memory>

#include "fcl_prob/whitening.h"
#include "oracle/oracle.h"

namespace oracle {

/// ε = mean + A Rᵀ y: A the axes that move, each as long as its standard deviation, all as the
/// displacement reports them, and R the rotation that the whitening adds, to 237 bits. Then y is a
/// standard normal, whatever was rounded in the whitening itself.
class WhitenedFrame {
 public:
  WhitenedFrame(const fcl_prob::Whitening& whitening,
                const fcl_prob::GaussianDisplacement& displacement);

  int rank() const { return rank_; }

  /// The displacement that is whitened to y.
  Displacement displacement(const Eigen::Vector3d& y) const;

  /// The same, rounded to doubles.
  Eigen::Vector3d rounded(const Eigen::Vector3d& y) const;

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
};

}  // namespace oracle
