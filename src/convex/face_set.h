// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The polygons of a closed surface in flat arrays that keep their memory from one use to the next.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "fcl_prob/convex_polytope.h"

namespace fcl_prob::detail {

/// Oriented polygons over shared vertices. A face's corners go counter-clockwise seen from outside.
/// Faces of one plane need not be merged; a body without volume is a two-sided polygon.
class FaceSet {
 public:
  void clear();

  int addVertex(const Eigen::Vector3d& position);
  void addFace(std::initializer_list<int> corners);

  /// A face built corner by corner: beginFace(), addCorner()...
  void beginFace() { first_.push_back(static_cast<int>(corners_.size())); }
  void addCorner(int vertex) { corners_.push_back(vertex); }

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  std::vector<Eigen::Vector3d>& vertices() { return vertices_; }

  std::size_t faceCount() const { return first_.size(); }
  int cornerCount(std::size_t face) const { return end(face) - first_[face]; }
  int corner(std::size_t face, int index) const { return corners_[first_[face] + index]; }
  const Eigen::Vector3d& position(std::size_t face, int index) const {
    return vertices_[corner(face, index)];
  }

  /// Vectors to which every edge is parallel, as long as the longest such edge, where they are
  /// known (a zonotope's generators); otherwise empty.
  const std::vector<Eigen::Vector3d>& edgeVectors() const { return edge_vectors_; }
  void addEdgeVector(const Eigen::Vector3d& edge) { edge_vectors_.push_back(edge); }

  /// Maps the whole surface.
  void transform(const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation);

  /// Area times the unit normal of a face.
  Eigen::Vector3d vectorArea(std::size_t face) const;

  /// Whether every edge is walked as often in one direction as in the other, so that the faces are
  /// the boundary of a body: a checksum that fails to notice an open surface once in 2^64.
  bool closed() const;

 private:
  int end(std::size_t face) const {
    return face + 1 < first_.size() ? first_[face + 1] : static_cast<int>(corners_.size());
  }

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Eigen::Vector3d> edge_vectors_;
  std::vector<int> first_;  // of each face, into corners_
  std::vector<int> corners_;
};

/// The faces of a polytope.
FaceSet toFaceSet(const ConvexPolytope& polytope);

/// The same surface as a ConvexPolytope; faces whose area is within rounding of zero are left out.
ConvexPolytope toPolytope(const FaceSet& faces);

/// With them, so that every edge is still shared by two faces; their normals mean nothing.
ConvexPolytope toClosedPolytope(const FaceSet& faces);

/// The axis-aligned box [lower, upper].
void setToBox(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, FaceSet& faces);

}  // namespace fcl_prob::detail
