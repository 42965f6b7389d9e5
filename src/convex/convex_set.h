// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A convex body with an exact support function and polytopes around and inside it.
#pragma once

#include <Eigen/Core>
#include <mutex>
#include <optional>

#include "convex/convex_mesh.h"
#include "convex/support_shape.h"
#include "convex/zonotope.h"

namespace fcl_prob::detail {

/// A convex body in its own frame, metres: what a ConvexBody holds. Immutable, thread-safe.
class ConvexSet {
 public:
  /// A box or a rounding of one, whose C-obstacles have a known structure; its polytopes are made
  /// when they are first asked for.
  /// \param resolution  how many points on the ball they are made of
  explicit ConvexSet(const RoundedZonotope& body, int resolution = 0)
      : rounded_(body), resolution_(resolution) {}

  /// A curved shape.
  /// \param resolution  how many points on the ball (disk: on its circle) its polytopes are made of
  ConvexSet(SupportShape shape, int resolution);

  explicit ConvexSet(ConvexMesh polytope);

  /// Set for boxes and their roundings.
  const std::optional<RoundedZonotope>& rounded() const { return rounded_; }

  bool isPolytope() const;

  /// A point of the set that lies farthest in a direction (any length).
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const;

  /// The shape that the set is, for a curved one; else null.
  const SupportShape* curvedShape() const;

  /// A polytope that contains the set, and one that it contains; for a polytope the set itself.
  const ConvexMesh& outerMesh() const { return forms().outer; }
  const ConvexMesh& innerMesh() const;

  /// Length of the longest position vector of the body or the polytope around it, or more.
  double size() const;

  /// The body reaches out of outerMesh() by no more than this (metres): 0 or rounding.
  double slack() const { return rounded_ ? 0.0 : outerMesh().slack; }

 private:
  struct Forms {
    std::optional<SupportShape> curved;
    ConvexMesh outer;
    ConvexMesh inner;  ///< of a curved one
  };

  const Forms& forms() const;
  static Forms formsOf(SupportShape shape, int resolution);
  static Forms formsOf(const RoundedZonotope& body, int resolution);

  std::optional<RoundedZonotope> rounded_;
  int resolution_ = 0;
  mutable std::once_flag once_;
  mutable Forms forms_;  // of a rounded zonotope: from the first call of forms() on
};

/// A box or a rounding of one by its support function.
SupportShape supportShape(const RoundedZonotope& body);

}  // namespace fcl_prob::detail
