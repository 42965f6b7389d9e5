// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A cell of the partition with what is still open in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "partition/cell_mass.h"
#include "partition/whitened_tree.h"

namespace fcl_prob::detail {

/// A pair of nodes whose C-obstacle may meet a cell. At two leaves `obstacle` is its index in the
/// ObstacleTable, otherwise -1. Without nodes (a = b = -1) it is a half-space of which the part
/// within the cell is known to collide, whatever pairs cause that.
struct FrontPair {
  NodePair nodes;
  int obstacle;

  bool isHalfSpace() const { return nodes.a < 0; }
};

/// A half-space { m·y >= s } of the whitened frame, m a unit vector.
struct CellPlane {
  Eigen::Vector3d m = Eigen::Vector3d::Zero();
  double s = 0.0;
};

/// An unresolved cell. `covered.m·y >= covered.s` certainly collides (if has_plane), and nothing
/// below `possible_from` along the same direction does.
struct OpenCell {
  Cell cell;
  std::vector<FrontPair> front;
  bool has_plane = false;
  CellPlane covered;
  Cell within{};
  double possible_from = 0.0;
  double lower = 0.0;  ///< certified mass that collides
  double upper = 0.0;  ///< certified mass that may collide
  double drawn = 0.0;  ///< mass of the set from which samples of the open part are drawn

  double gap() const { return upper - lower; }

  /// `within` is the whole cell: only what lies between the planes is open.
  bool coversToTheSides() const { return within.lo == cell.lo && within.hi == cell.hi; }

  /// Whether a point of the cell is in the covered part.
  bool covers(const Eigen::Vector3d& y) const {
    return has_plane && covered.m.dot(y) >= covered.s && (y.array() >= within.lo.array()).all() &&
           (y.array() <= within.hi.array()).all();
  }

  /// Bound on the standard deviation of one sample of the open mass: it is drawn from a set of mass
  /// `drawn` and is 0 or that mass, with a mean of at most the gap.
  double samplingDeviation() const {
    const double mean = std::clamp(gap(), 0.0, 0.5 * drawn);
    return std::sqrt(mean * (drawn - mean));
  }
  std::size_t memory() const { return sizeof(OpenCell) + front.capacity() * sizeof(FrontPair); }
};

}  // namespace fcl_prob::detail
