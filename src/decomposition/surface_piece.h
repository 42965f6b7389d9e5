// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A part of a surface, cut by planes.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// The half-space normal·x <= offset, and the plane that bounds it.
struct CutPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double offset = 0.0;

  double height(const Eigen::Vector3d& point) const { return normal.dot(point) - offset; }
  CutPlane flipped() const { return {-normal, -offset}; }
};

/// Convex polygons over shared vertices.
class SurfacePiece {
 public:
  SurfacePiece() = default;
  explicit SurfacePiece(const TriangleMesh& mesh);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }

  /// Every side of a polygon, once.
  const std::vector<std::pair<int, int>>& edges() const { return edges_; }

  bool isEmpty() const { return vertices_.empty(); }

  /// What of the polygons is in the half-space. Where a side crosses the plane, the new vertex is
  /// the same for the piece on the other side, so that the two leave nothing out but by rounding.
  /// Polygons that only touch the plane are left out; those that lie in it are kept if asked for.
  SurfacePiece below(const CutPlane& plane, bool keep_coplanar) const;

 private:
  int polygonEnd(std::size_t polygon) const {
    return polygon + 1 < first_.size() ? first_[polygon + 1] : static_cast<int>(corners_.size());
  }
  void findEdges();

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<int> first_;  // of each polygon, into corners_
  std::vector<int> corners_;
  std::vector<std::pair<int, int>> edges_;
};

/// Where the side from `low` to `high`, given with their heights of different signs, crosses the
/// plane.
inline Eigen::Vector3d crossingPoint(const Eigen::Vector3d& low, double low_height,
                                     const Eigen::Vector3d& high, double high_height) {
  return low + (low_height / (low_height - high_height)) * (high - low);
}

}  // namespace fcl_prob::detail
