// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Boxes around C-obstacles for lines that are drawn through them. Nothing of them is certified.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// A line through the displacement space.
struct RandomLine {
  Eigen::Vector3d origin;  ///< across the direction
  Eigen::Vector3d direction;
};

/// A box, turned towards the mean displacement, around the C-obstacle of two nodes with room on all
/// sides of it, so that no line that meets the C-obstacle is short within the box.
class RoomyBox {
 public:
  /// All of the space, or nothing.
  explicit RoomyBox(int rank, double mass = 1.0);

  RoomyBox(const WhitenedPair& pair, NodePair nodes, int rank);

  /// Of the normal distribution; 0 where the displacement reaches nothing of the C-obstacle.
  double mass() const { return mass_; }

  /// Of the normal distribution on a line.
  double massAlong(const RandomLine& line) const;

  /// No more than that of a line through a point of the C-obstacle, over the density there (that of
  /// the distance along the line from where it is nearest to the mean).
  double massOverDensity() const { return mass_over_density_; }

  /// A point of the normal distribution within the box.
  Eigen::Vector3d point(const std::array<std::uint64_t, 4>& words) const;

 private:
  void fit(const WhitenedPair& pair, NodePair nodes, const Eigen::Matrix3d& axes);

  int rank_;
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  ///< one a row
  Eigen::Vector3d lo_;
  Eigen::Vector3d hi_;
  double mass_;
  double mass_over_density_;
};

}  // namespace fcl_prob::detail
