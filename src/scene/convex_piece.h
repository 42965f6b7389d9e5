// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A convex piece of a geometry, whitened or not.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "convex/support_shape.h"

namespace fcl_prob::detail {

/// A vector along an edge, and a bound on the terms that its coordinates are sums of. What it is
/// rounded by is 8 ε of that.
struct PieceEdge {
  Eigen::Vector3d along;
  Eigen::Vector3d magnitude;
};

/// A convex body relative to its position, with what its C-obstacles need: if it is a polytope,
/// every face as a pair of spanning vectors, and the directions of the edges. All of it transforms
/// linearly.
struct ConvexPiece {
  SupportShape body;
  std::vector<std::pair<PieceEdge, PieceEdge>> faces;
  std::vector<PieceEdge> edges;

  void addEdge(const Eigen::Vector3d& along) { edges.push_back(exactEdge(along)); }
  void addFace(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    faces.emplace_back(exactEdge(p), exactEdge(q));
  }

  /// The image under a linear map. \param magnitudes  bound the terms that its entries are sums of
  ConvexPiece mapped(const Eigen::Matrix3d& linear, const Eigen::Matrix3d& magnitudes) const;

  /// An edge that is given, or the difference of two points: rounded once.
  static PieceEdge exactEdge(const Eigen::Vector3d& along) { return {along, along.cwiseAbs()}; }
};

/// The hull of some points, of whatever dimension they span.
ConvexPiece polytopePiece(const std::vector<Eigen::Vector3d>& points);

/// An axis-aligned cube about its middle.
ConvexPiece cubePiece(double side);

}  // namespace fcl_prob::detail
