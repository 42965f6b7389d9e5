// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex sets with an exact support function and polytopes around and inside them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cobstacle/convex_mesh.h"
#include "cobstacle/support_shape.h"

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

  /// The shape that the set is, for a curved one.
  virtual const SupportShape* curvedShape() const { return nullptr; }

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

/// A curved shape.
class SweptSet final : public ConvexSet {
 public:
  /// \param resolution  how many points on the ball (disk: on its circle) the polytopes are made of
  SweptSet(SupportShape shape, int resolution);

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const override {
    return shape_.supportPoint(direction);
  }
  const SupportShape* curvedShape() const override { return &shape_; }
  const ConvexMesh& outerMesh() const override { return outer_; }
  const ConvexMesh& innerMesh() const override { return inner_; }

 private:
  ConvexMesh hullOf(const std::vector<Eigen::Vector3d>& ball, double scale) const;

  SupportShape shape_;
  ConvexMesh outer_;
  ConvexMesh inner_;
};

}  // namespace fcl_prob::detail
