// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How far the parts of an object may be from where their poses put them, along a direction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/partition_object.h"

namespace fcl_prob::detail {

/// The parts of an object that have a `sweep`. A turn moves no point along its own axis, and the
/// points of a part only as far along another direction as the part is wide: a box around the part
/// in its own axes says how far that is at most.
class SweptParts {
 public:
  SweptParts() = default;
  explicit SweptParts(const PartitionObject& object);

  bool isEmpty() const { return parts_.empty(); }

  /// Upper bound of n·d over the displacements d of the points of a node. \param n  world frame,
  /// any length
  double along(const Eigen::Vector3d& n, int node) const;

 private:
  /// A part and the half widths, along its axes, of a box around its sweep's centre.
  struct Part {
    const PointMotion* sweep;
    Eigen::Matrix3d axes;
    Eigen::Vector3d half;
  };

  static Part boxed(const PieceTree& tree, const PieceTree::Part& part, const PlacedPart& placed);
  static double alongPart(const Part& part, const Eigen::Vector3d& n);
  static double radiusOf(const Part& part);

  std::vector<Part> parts_;         ///< one a part of the object
  std::vector<int> part_of_node_;   ///< -1: of several
  double radius_of_several_ = 0.0;  ///< no point of any part is displaced further
};

}  // namespace fcl_prob::detail
