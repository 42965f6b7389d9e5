// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A convex cell, and what of a solid reaches into its corners.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "convex/cut_polytope.h"
#include "decomposition/surface_piece.h"
#include "geometry/closed_mesh.h"

namespace fcl_prob::detail {

/// What of a solid is in a convex cell has no other extreme points than those of its surface in the
/// cell and corners of the cell that the solid reaches into.
class SolidCell {
 public:
  /// The whole solid. \param solid  null for an open mesh, which has no inside; must outlive this
  SolidCell(const TriangleMesh& mesh, const ClosedMesh* solid);

  SolidCell below(const CutPlane& plane) const;

  /// Corners inside the solid, and those on its surface next to which the cell has the solid.
  const std::vector<Eigen::Vector3d>& cornersInside() const { return corners_inside_; }

 private:
  SolidCell() = default;
  void findCorners();
  bool reachesInto(const Eigen::Vector3d& corner,
                   const std::vector<Eigen::Vector3d>& corners) const;

  const ClosedMesh* solid_ = nullptr;
  CutPolytope cell_;
  std::vector<Eigen::Vector3d> corners_inside_;
};

}  // namespace fcl_prob::detail
