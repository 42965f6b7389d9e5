// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a query keeps of one geometry, whatever its pose.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Geometry>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "convex/convex_solid.h"
#include "fcl_prob/convex_body.h"
#include "fcl_prob/probability_request.h"
#include "geometry/closed_mesh.h"
#include "scene/piece_tree.h"

namespace fcl_prob::detail {

/// Checks a geometry once; the rest is built when a method first needs it. Const calls are safe on
/// several threads.
class PreparedGeometry {
 public:
  /// \param name  how messages call it
  /// \throws InvalidGeometry, UnsupportedGeometry
  PreparedGeometry(std::shared_ptr<const fcl::CollisionGeometryd> geometry, std::string name);

  const fcl::CollisionGeometryd& geometry() const { return *geometry_; }

  /// Whether the partition can handle it: whatever is bounded.
  bool hasPieces() const;
  const PieceTree& pieces() const;

  /// Whether it has a bounded convex body around it: itself, or the root volume of a mesh.
  bool hasRootBody() const;
  const ConvexBody& rootBody() const;

  /// Of what has a root body: itself, or the convex hull of a mesh, or the root volume of a mesh of
  /// very many vertices.
  const ConvexBody& hull() const;

  /// Whether it is a bounded convex shape, which rootBody() then is.
  bool isConvex() const;

  /// Itself, of a polytope with an inside, or the polytope that a closed convex mesh is; else null.
  const ConvexSolid* convexSolid() const;

  /// A box (frame of the geometry, metres) that contains all of it, up to the rounding of its own
  /// coordinates: infinite for what is unbounded, empty for an octree without occupied cells. It
  /// does not rest on `aabb_local`, which FCL computes when it is told to.
  const Eigen::AlignedBox3d& localBox() const;

  /// The solid that a mesh encloses; null where surfaces count, and for what is no mesh.
  /// \throws OpenMesh
  const ClosedMesh* solid(ContactMeaning contact) const;

 private:
  Eigen::AlignedBox3d findLocalBox() const;

  std::shared_ptr<const fcl::CollisionGeometryd> geometry_;
  std::string name_;
  mutable std::once_flag pieces_once_;
  mutable std::shared_ptr<const PieceTree> pieces_;
  mutable std::once_flag local_box_once_;
  mutable Eigen::AlignedBox3d local_box_;
  mutable std::once_flag root_once_;
  mutable std::unique_ptr<const ConvexBody> root_body_;
  mutable std::once_flag hull_once_;
  mutable std::unique_ptr<const ConvexBody> hull_;
  mutable std::once_flag convex_solid_once_;
  mutable std::unique_ptr<const ConvexSolid> convex_solid_;
  mutable std::once_flag solid_once_;
  mutable std::unique_ptr<const ClosedMesh> solid_;
};

/// Shared, so that an object of many queries is prepared once.
using PreparedGeometries = std::vector<std::shared_ptr<const PreparedGeometry>>;

}  // namespace fcl_prob::detail
