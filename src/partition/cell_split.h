// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where a cell is divided.
#pragma once

#include "partition/open_cell.h"

namespace fcl_prob::detail {

struct CellSplit {
  int axis;  ///< -1: the cell cannot be divided further in double precision
  double at;
};

/// Across the axis along which the density, and what is known of the cell, change most.
/// \param scales  for each axis, the length over which anything changes
CellSplit chooseSplit(const OpenCell& open, const Eigen::Vector3d& scales);

}  // namespace fcl_prob::detail
