// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether one object is inside the other where their surfaces do not meet (contact = solid).
#pragma once

#include <vector>

#include "fcl_prob/whitening.h"
#include "partition/cell_mass.h"
#include "partition/whitened_tree.h"

namespace fcl_prob::detail {

class SolidContact {
 public:
  SolidContact(const PartitionObject& a, const PartitionObject& b, const Whitening& whitening,
               const WhitenedPair& pair);

  /// False only if neither object can be inside the other for any displacement of the cell.
  bool possible(const Cell& cell) const;

  /// Whether, at a whitened displacement at which the surfaces do not meet, the solids overlap.
  Containment at(const Eigen::Vector3d& y) const;

 private:
  /// One direction of one pair of parts: `inner` inside `outer`.
  struct Direction {
    const ClosedMesh* outer;
    std::vector<Eigen::Vector3d> points;  ///< of the inner object, frame of the outer one
    Eigen::Matrix3d shift;     ///< displacement in the world to the frame of the outer one
    NodeBox outer_box;         ///< whitened
    NodeBox inner_box;         ///< whitened, at y = 0
    double sign;               ///< of the whitened displacement of the inner object
    Eigen::Vector3d rounding;  ///< of the boxes, which are padded outwards
  };

  void addDirections(const PartitionObject& inner, const WhitenedTree& of_inner,
                     const PartitionObject& outer, const WhitenedTree& of_outer, double sign);
  Containment decide(const Direction& direction, const Eigen::Vector3d& displacement) const;
  static bool fits(const Direction& direction, const Cell& cell);

  Whitening whitening_;
  std::vector<Direction> directions_;
};

}  // namespace fcl_prob::detail
