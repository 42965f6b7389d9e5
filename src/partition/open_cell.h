// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A cell of the partition with what is still open in it.
#pragma once

#include <cstddef>
#include <vector>

#include "partition/cell_mass.h"

namespace fcl_prob::detail {

/// A pair of nodes whose C-obstacle may meet a cell. At two leaves `obstacle` is its index in the
/// ObstacleTable, otherwise -1.
struct FrontPair {
  int a;
  int b;
  int obstacle;
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
  double possible_from = 0.0;
  double lower = 0.0;  ///< certified mass that collides
  double upper = 0.0;  ///< certified mass that may collide

  double gap() const { return upper - lower; }
  std::size_t memory() const { return sizeof(OpenCell) + front.capacity() * sizeof(FrontPair); }
};

}  // namespace fcl_prob::detail
