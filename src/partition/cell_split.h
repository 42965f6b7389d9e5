// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where a cell is divided.
#pragma once

#include "partition/cell_mass.h"

namespace fcl_prob::detail {

struct CellSplit {
  int axis;  ///< -1: the cell cannot be divided further in double precision
  double at;
};

/// Across the axis along which the density changes most over the cell.
CellSplit chooseSplit(const Cell& cell);

}  // namespace fcl_prob::detail
