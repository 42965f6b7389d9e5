// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex bodies within a mesh, as far as it does not reach into them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/closed_mesh.h"
#include "geometry/mesh_visitor.h"
#include "scene/convex_fan.h"

namespace fcl_prob::detail {

/// A closed mesh around bodies, with what is needed to see that it is.
class SurroundingMesh {
 public:
  static constexpr double kMostReach = 1e-5;

  /// \param vertices  the mesh's, perhaps moved; those of `view` tell rounding
  /// \param moved_by  vertices[i] is view.vertices[i] less this, up to rounding
  ///
  /// Keeps what the view is of, and the vertices, by reference. \throws OpenMesh
  SurroundingMesh(const MeshView& view, const std::vector<Eigen::Vector3d>& vertices,
                  const Eigen::Vector3d& moved_by);

  /// Whether the mesh winds around P and hardly reaches into it: no triangle meets the inside of P
  /// shrunk about its centre by a share of kMostReach at the most, since there is a plane between
  /// the two. The depths are then no smaller than that share of P, so that what is told of P's
  /// inside is told of what the mesh does not reach. \param normals  of planes to try beside those
  /// of P
  bool surrounds(ConvexFan& fan, const std::vector<Eigen::Vector3d>& normals) const;

 private:
  double reachInto(const ConvexFan& fan, const std::vector<Eigen::Vector3d>& normals) const;

  const MeshView view_;
  const std::vector<Eigen::Vector3d>& vertices_;
  Eigen::Vector3d moved_by_;
  ClosedMesh solid_;
  std::vector<double> lengths_;  ///< of the vertices of the view
  BoxTree boxes_;                ///< of triangles
  double largest_ = 0.0;         ///< of those lengths that triangles have
};

}  // namespace fcl_prob::detail
