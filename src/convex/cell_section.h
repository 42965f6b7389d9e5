// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How a C-obstacle known by its support function meets an axis-aligned cell.
#pragma once

#include <Eigen/Core>

#include "convex/support_obstacle.h"

namespace fcl_prob::detail {

/// The obstacle between two parallel planes within a cell: V ∩ cell lies in { normal·y <= outer },
/// and all of cell ∩ { normal·y <= inner } belongs to V. Both are certified: `outer` is a support
/// value, and `inner` is that of an explicit hull of points of V.
struct CellSection {
  enum class Relation { outside, inside, cut };

  Relation relation = Relation::cut;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit; zero: no plane was found
  double outer = 0.0;
  double inner = 0.0;  ///< below the whole cell if nothing of it certainly belongs to V
};

/// \param lo, hi  the cell, whitened; along the axes from `rank` on lo = hi = 0
CellSection sectionOf(const SupportObstacle& obstacle, const Eigen::Vector3d& lo,
                      const Eigen::Vector3d& hi, int rank);

/// Whether a point belongs to V, up to rounding: for sampling, which is not certified.
bool contains(const SupportObstacle& obstacle, const Eigen::Vector3d& point);

}  // namespace fcl_prob::detail
