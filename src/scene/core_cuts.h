// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Half-spaces that leave of the hull of a mesh what is behind its dents.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fcl_prob/convex_polytope.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {

/// { n·x <= offset }
struct CoreCut {
  Eigen::Vector3d n;
  double offset;
};

/// Every triangle is to be beyond one of these or next to a face of the hull; as little as possible
/// of the hull is to be cut off. Nothing if too much or too often were to be cut. Only a search:
/// nothing is certified of it.
/// \param vertices  the mesh's, by which its triangles are given
std::optional<std::vector<CoreCut>> findCoreCuts(const MeshView& view,
                                                 const std::vector<Eigen::Vector3d>& vertices,
                                                 const ConvexPolytope& hull);

}  // namespace fcl_prob::detail
