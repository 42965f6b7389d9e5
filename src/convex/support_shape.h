// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex shapes by their support functions, in closed form.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <vector>

#include "convex/touching_face.h"

namespace fcl_prob::detail {

/// The convex hull of points, some of which are swept by an ellipsoid: conv ∪ (p_i ⊕ s_i E·ball)
/// with s_i either 0 or 1. All of FCL's bounded convex shapes are of this form (a cone is the hull
/// of its apex and the disk, a flat ellipsoid, around the centre of its base), and so are their
/// images under linear maps.
struct SupportShape {
  std::vector<Eigen::Vector3d> points;  ///< the first `swept` of them are centres of the ellipsoid
  int swept = 0;
  Eigen::Matrix3d semi_axes = Eigen::Matrix3d::Zero();  ///< columns; the third may be 0 (a disk)

  bool curved() const { return swept > 0; }

  /// A point of the shape that lies farthest in a direction (any length).
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const;

  /// Derivative of the support point with respect to the direction: zero where the point is a
  /// corner, and across a flat side, where the support point jumps.
  Eigen::Matrix3d supportDerivative(const Eigen::Vector3d& direction) const;

  /// All points that lie farthest, up to rounding.
  TouchingFace touchingFace(const Eigen::Vector3d& direction) const;

  /// max of direction·x over the shape, up to rounding.
  double supportValue(const Eigen::Vector3d& direction) const;

  /// Second moments about the centre, roughly: how wide the shape is in which direction.
  Eigen::Matrix3d spread() const;

  /// Unit normals of the flat sides that follow from the shape's form: of a disk.
  std::vector<Eigen::Vector3d> sideNormals() const;

  /// A point in the relative interior.
  Eigen::Vector3d centre() const;

  /// Length of the longest position vector, or a little more.
  double radius() const;

  SupportShape transformed(const Eigen::Matrix3d& linear) const;
};

/// One of FCL's bounded convex shapes in its own frame, metres.
/// \throws UnsupportedGeometry for any other geometry
SupportShape supportShape(const fcl::CollisionGeometryd& geometry);

}  // namespace fcl_prob::detail
