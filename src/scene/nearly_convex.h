// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A closed mesh that is not convex, but nearly: between two convex polytopes.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "geometry/mesh_visitor.h"
#include "scene/convex_fan.h"

namespace fcl_prob::detail {

/// What lies between the two is what such a mesh leaves open when it is taken for convex.
struct NearlyConvex {
  /// P is the hull of all vertices. Nothing is said of its inside.
  ConvexFan hull;

  /// The mesh winds around P, and no triangle of it reaches farther into P than the depths tell.
  ConvexFan core;

  /// The volume of the core as a share of that of the hull.
  double share = 0.0;
};

/// Null if the mesh is not closed, is far from convex, or has more triangles than are looked at.
/// For the arguments see convexFanOf(), which tells whether the mesh is convex.
std::shared_ptr<const NearlyConvex> nearlyConvexOf(const MeshView& view,
                                                   const std::vector<Eigen::Vector3d>& vertices,
                                                   const Eigen::Vector3d& moved_by);

}  // namespace fcl_prob::detail
