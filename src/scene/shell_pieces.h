// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What of a mesh the core of a nearly convex one does not hold, as small convex bodies.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fcl_prob/triangle_mesh.h"
#include "geometry/mesh_visitor.h"
#include "scene/convex_fan.h"
#include "scene/mesh_reach.h"

namespace fcl_prob::detail {

/// Bodies that hold, with the core, the whole mesh: of convex patches of the triangles that have a
/// corner which is none of the core's, each the hull of a patch and of a point below it, with what
/// is told of NearlyConvex::core. Empty where a triangle has none, or there would be too many.
/// \param apex  deep inside
std::vector<ConvexFan> shellPieces(const MeshView& view,
                                   const std::vector<Eigen::Vector3d>& vertices,
                                   const SurroundingMesh& mesh, const TriangleMesh& core,
                                   const Eigen::Vector3d& apex);

}  // namespace fcl_prob::detail
