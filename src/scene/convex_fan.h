// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A closed mesh that is convex up to the rounding of its vertices, or a solid one, as one polytope.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "fcl_prob/convex_polytope.h"
#include "geometry/closed_mesh.h"
#include "geometry/mesh_visitor.h"
#include "geometry/surface_caps.h"

namespace fcl_prob::detail {

/// The convex hull P of a closed mesh that hardly deviates from it, by the normals of groups of
/// triangles that lie in one plane as far as their vertices tell.
///
/// Every triangle of group f lies in { offsets[f] - depths[f] <= n·(v - centre) <= offsets[f] },
/// and P in the upper half of that; the mesh winds around the centre. The groups around every
/// vertex span a convex cone whose edges are among the arcs. From this alone follows what a
/// polytope P ⊕ T contains (docs/rounding.md); that the groups are P's faces is nowhere assumed.
struct ConvexFan {
  Eigen::Vector3d centre;                 ///< metres, in the frame of the vertices given
  double radius = 0.0;                    ///< of a ball around the centre with everything
  std::vector<Eigen::Vector3d> vertices;  ///< each once, relative to the centre
  std::vector<Eigen::Vector3d> normals;   ///< of the groups, outward, unit
  std::vector<double> offsets;
  std::vector<double> depths;
  std::vector<std::pair<int, int>> arcs;  ///< pairs of neighbouring groups
};

/// Null if the mesh is not closed or not convex, or has more triangles than are looked at.
/// \param vertices  the mesh's, perhaps moved; those of `view` say what is inside
/// \param moved_by  vertices[i] is view.vertices[i] less this, up to rounding
std::shared_ptr<const ConvexFan> convexFanOf(const MeshView& view,
                                             const std::vector<Eigen::Vector3d>& vertices,
                                             const Eigen::Vector3d& moved_by);

/// The same of a solid polytope, P being the hull of all points. Null if it is flat, or has too
/// many faces. \param hull  theirs
std::shared_ptr<const ConvexFan> convexFanOf(const ConvexPolytope& hull,
                                             const std::vector<Eigen::Vector3d>& points);

/// Whether the centre of a fan is certainly within a solid.
/// \param moved_by  added to what is relative to the fan's frame, up to rounding
bool hasCentreWithin(const ConvexFan& fan, const ClosedMesh& solid,
                     const Eigen::Vector3d& moved_by);

/// Of every connected part of a mesh two vertices far apart; nothing if it has too many parts.
std::vector<std::pair<int, int>> spansOf(const MeshView& view, const SurfaceComponents& components);

}  // namespace fcl_prob::detail
