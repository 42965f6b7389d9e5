// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacle of two convex bodies that are known by their support functions.
#pragma once

#include <Eigen/Core>
#include <array>

#include "convex/support_shape.h"

namespace fcl_prob::detail {

/// A body in the whitened frame: a shape moved to a position, or a triangle.
class SupportBody {
 public:
  /// Keeps a reference to `shape`.
  SupportBody(const SupportShape& shape, const Eigen::Vector3d& position)
      : shape_(&shape), position_(position) {}

  SupportBody(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
      : corners_{a, b, c} {}

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const;
  double supportValue(const Eigen::Vector3d& direction) const;
  Eigen::Matrix3d supportDerivative(const Eigen::Vector3d& direction) const;
  TouchingFace touchingFace(const Eigen::Vector3d& direction) const;
  Eigen::Vector3d centre() const;
  Eigen::Matrix3d spread() const;
  std::vector<Eigen::Vector3d> sideNormals() const;

 private:
  const Eigen::Vector3d& farthestCorner(const Eigen::Vector3d& direction) const;

  const SupportShape* shape_ = nullptr;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, 3> corners_;
};

/// V = B ⊕ (−A) in the whitened frame.
class SupportObstacle {
 public:
  /// \param error  no coordinate of a computed support point is farther from the true one than this
  SupportObstacle(const SupportBody& a, const SupportBody& b, const Eigen::Vector3d& error);

  /// A point of V, within error(), that lies farthest in a direction (any length).
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const {
    return b_.supportPoint(direction) - a_.supportPoint(-direction);
  }

  /// Derivative of supportPoint(): the inverse of the curvature of the boundary.
  Eigen::Matrix3d supportDerivative(const Eigen::Vector3d& direction) const {
    return b_.supportDerivative(direction) + a_.supportDerivative(-direction);
  }

  /// Of a point of the boundary of V, where its outward normal is `normal`: the point of A that
  /// touches B there.
  Eigen::Vector3d touchingPointOfA(const Eigen::Vector3d& boundary,
                                   const Eigen::Vector3d& normal) const {
    return touchingPoint(a_.touchingFace(-normal), b_.touchingFace(normal), boundary);
  }

  /// Certainly not below direction·y on V.
  double supportUpper(const Eigen::Vector3d& direction) const {
    return b_.supportValue(direction) + a_.supportValue(-direction) + errorAlong(direction);
  }

  /// A point of V, within error(), that is inside unless V has no inside.
  const Eigen::Vector3d& centre() const { return centre_; }

  /// Bound on the error of a support point, as a distance.
  double error() const { return error_.norm(); }

  /// The same along a direction, and that of a support value.
  double errorAlong(const Eigen::Vector3d& direction) const {
    return direction.cwiseAbs().dot(error_);
  }

  /// Second moments of the two bodies, added: how wide V is in which direction, roughly.
  Eigen::Matrix3d spread() const { return a_.spread() + b_.spread(); }

  /// Unit normals of flat sides that V certainly has, up to their signs; not all of them.
  std::vector<Eigen::Vector3d> sideNormals() const;

 private:
  SupportBody a_;
  SupportBody b_;
  Eigen::Vector3d error_;
  Eigen::Vector3d centre_;
};

}  // namespace fcl_prob::detail
