// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The mass that two C-obstacles have in common.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "convex/face_set.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// A whitened C-obstacle with flat sides.
class KnownObstacle {
 public:
  /// \param faces  whose vertices are known up to `error`
  KnownObstacle(FaceSet faces, double error);

  /// Its faces, narrow ones merged with their neighbours where that is possible.
  const FaceSet& faces() const { return faces_; }

  /// No point of the obstacle is further from what faces() enclose.
  double error() const { return error_; }

  /// Outward unit normals of its faces.
  const std::vector<Eigen::Vector3d>& normals() const { return normals_; }

  /// The obstacle is below normal·y = outer; points that are below `inner` for all faces are in it.
  const std::vector<double>& outer() const { return outer_; }
  const std::vector<double>& inner() const { return inner_; }

  /// Whether a point is in it, as far as rounding allows to say so.
  bool contains(const Eigen::Vector3d& point) const;

 private:
  void setPlanes(double inner_error);

  FaceSet faces_;
  double error_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<double> outer_;
  std::vector<double> inner_;
};

/// Certified mass of the intersection under N(0, I).
Bounds intersectionMass(const KnownObstacle& a, const KnownObstacle& b);

}  // namespace fcl_prob::detail
