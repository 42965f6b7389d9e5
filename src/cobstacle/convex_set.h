// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex sets with an exact support function and polytopes around and inside them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cobstacle/convex_mesh.h"

namespace fcl_prob::detail {

/// A convex body in its own frame, metres. Immutable.
class ConvexSet {
 public:
  virtual ~ConvexSet() = default;

  /// A point of the set that lies farthest in a direction (any length).
  virtual Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const = 0;

  /// A polytope that contains the set, and one that it contains; for a polytope the set itself.
  virtual const ConvexMesh& outerMesh() const = 0;
  virtual const ConvexMesh& innerMesh() const = 0;

  bool isPolytope() const { return &outerMesh() == &innerMesh(); }

  /// The set reaches out of outerMesh() by no more than this (metres): 0 or rounding.
  double slack() const { return outerMesh().slack; }

  /// Length of the longest position vector of outerMesh().
  double size() const;
};

class PolytopeSet final : public ConvexSet {
 public:
  explicit PolytopeSet(ConvexMesh mesh) : mesh_(std::move(mesh)) {}

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const override {
    return mesh_.supportPoint(direction);
  }
  const ConvexMesh& outerMesh() const override { return mesh_; }
  const ConvexMesh& innerMesh() const override { return mesh_; }

 private:
  ConvexMesh mesh_;
};

/// The convex hull of points and ellipsoids: conv ∪ (v_i ⊕ s_i E·ball) with s_i either 0 or 1. All
/// of FCL's shapes with curved sides are of this form: a cone is the hull of its apex and the disk
/// (flat ellipsoid) around the centre of its base.
class SweptSet final : public ConvexSet {
 public:
  struct Centre {
    Eigen::Vector3d position;
    bool swept;
  };

  /// \param semi_axes   columns are the semi-axes of the ellipsoid; the third may be zero (a disk)
  /// \param resolution  how many points on the ball (disk: on its circle) the polytopes are made of
  SweptSet(std::vector<Centre> centres, const Eigen::Matrix3d& semi_axes, int resolution);

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const override;
  const ConvexMesh& outerMesh() const override { return outer_; }
  const ConvexMesh& innerMesh() const override { return inner_; }

 private:
  ConvexMesh hullOf(const std::vector<Eigen::Vector3d>& ball, double scale) const;

  std::vector<Centre> centres_;
  Eigen::Matrix3d semi_axes_;
  ConvexMesh outer_;
  ConvexMesh inner_;
};

}  // namespace fcl_prob::detail
