// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Boxes that together contain every displacement that collides.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <Eigen/Core>
#include <vector>

#include "base/interruption.h"

namespace fcl_prob::detail {

/// A box of the whitened frame, with its mass under N(0, I) of the coordinates that move.
struct CoverBox {
  Eigen::Vector3d lo;
  Eigen::Vector3d hi;
  double mass;
};

/// A set that contains every displacement that collides: the union of boxes, or everything at least
/// `shell_radius` from the mean if that is not 0.
struct ObstacleCover {
  std::vector<CoverBox> boxes;
  double shell_radius = 0.0;
  double mass = 0.0;  ///< of the boxes together, or of the shell

  bool empty() const { return boxes.empty() && shell_radius == 0.0; }
};

/// One of two objects in the whitened frame.
struct CoverSide {
  const fcl::BVHModel<fcl::AABBd>& tree;
  bool surface;  ///< only its triangles collide; else also what they enclose, and the tree is not
                 ///< opened
};

/// Covers the displacements y at which side A, moved by y, meets side B. The total mass of the
/// boxes, a union bound on P, is made small by opening the pairs of nodes of largest mass, as long
/// as that helps and is not interrupted. Boxes that no displacement reaches are left out. \param
/// margin  added to every box on every side
ObstacleCover coverByBoxes(const CoverSide& a, const CoverSide& b, int rank,
                           const Eigen::Vector3d& margin, const Interruption& interruption);

/// Covers an obstacle no point of which is closer to the mean than `radius`.
ObstacleCover coverByShell(double radius, int rank);

}  // namespace fcl_prob::detail
