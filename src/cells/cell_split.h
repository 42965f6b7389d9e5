// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where a cell is divided.
#pragma once

#include "mass/cell_mass.h"

namespace fcl_prob::detail {

struct CellSplit {
  int axis;  ///< -1: the cell cannot be divided further in double precision
  double at;
};

/// Across the axis along which the density, and what is known of the cell, change most.
/// \param scales  for each axis, the length over which anything changes
/// \param normal  unit, of the plane beyond which contact is known; 0 if there is none
CellSplit chooseSplit(const Cell& cell, const Eigen::Vector3d& scales,
                      const Eigen::Vector3d& normal = Eigen::Vector3d::Zero());

}  // namespace fcl_prob::detail
