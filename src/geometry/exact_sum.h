// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Sums in which nothing is lost where their terms cancel.
#pragma once

#include <fcl/common/types.h>

#include <Eigen/Core>
#include <array>

namespace fcl_prob::detail {

using LongVector = Eigen::Matrix<long double, 3, 1>;

/// The exact sum of up to kMostTerms numbers, kept as numbers that do not overlap (Shewchuk,
/// "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997,
/// theorem 10). Nothing may overflow; what a product loses below the smallest number, 2⁻¹⁰⁷⁵, is
/// lost.
class ExactSum {
 public:
  /// A product counts as two.
  static constexpr int kMostTerms = 48;

  void add(double x);
  void addProduct(double x, double y);

  /// Within 2⁻⁶² of the sum, relative, or of the precision of a long double where that is less.
  long double value() const;

 private:
  std::array<double, kMostTerms> parts_;  ///< ascending
  int count_ = 0;
};

/// A sum of positions in the world, or of differences of them: far from the origin the terms are
/// large and nearly cancel.
class ExactPosition {
 public:
  /// Adds `sign` times a vector; sign is 1 or -1.
  void add(const Eigen::Vector3d& v, double sign = 1.0);

  /// Adds `sign` times the point, given in the frame that `pose` places.
  void add(const fcl::Transform3d& pose, const Eigen::Vector3d& point, double sign = 1.0);

  LongVector value() const;

 private:
  std::array<ExactSum, 3> sums_;
};

}  // namespace fcl_prob::detail
