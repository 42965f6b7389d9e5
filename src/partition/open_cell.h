// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A cell of the partition with what is still open in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "partition/covered_part.h"
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

/// An unresolved cell. With a plane, nothing below `possible_from` along its normal collides; if it
/// covers, all above it certainly does. So does `part`, which has none of that.
struct OpenCell {
  Cell cell;
  std::vector<FrontPair> front;
  bool has_plane = false;
  bool plane_covers = false;
  CellPlane plane;
  CoveredPart part;
  double possible_from = 0.0;
  double lower = 0.0;  ///< certified mass that collides
  double upper = 0.0;  ///< certified mass that may collide
  double drawn = 0.0;  ///< mass of the set from which samples of the open part are drawn

  double gap() const { return upper - lower; }

  /// Bound on the standard deviation of one sample of the open mass: it is drawn from a set of mass
  /// `drawn` and is 0 or that mass, with a mean of at most the gap.
  double samplingDeviation() const {
    const double mean = std::clamp(gap(), 0.0, 0.5 * drawn);
    return std::sqrt(mean * (drawn - mean));
  }
  std::size_t memory() const { return sizeof(OpenCell) + front.capacity() * sizeof(FrontPair); }
};

}  // namespace fcl_prob::detail
