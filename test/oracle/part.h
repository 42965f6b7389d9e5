// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One placed geometry as convex pieces with a tree of boxes, for the oracle.
#pragma once

#include <fcl/geometry/collision_geometry.h>
#include <fcl/geometry/octree/octree.h>

#include <vector>

#include "convex_set.h"

namespace oracle {

/// What counts as contact.
enum class Contact {
  surface,  ///< contact = fcl: meshes are surfaces
  solid     ///< closed meshes are solids too
};

struct PieceBox {
  LongVector lo;
  LongVector hi;
};

/// Over the pieces of one part; the children of a node stand behind it.
struct PieceNode {
  PieceBox box;
  int left = -1;
  int right = -1;
  int piece = -1;  ///< at a leaf
};

/// { normal·x <= offset }, or for a plane with equality, as fcl::transform places it: normal = R n,
/// offset = d + normal·t.
struct UnboundedSet {
  ExactVector exact_normal;
  Rational exact_offset;
  WideVector normal;  ///< rounded, as is `offset`
  Wide offset;
  bool surface = false;
};

class Part {
 public:
  /// Keeps a reference to `geometry`. \throws std::invalid_argument for what is no geometry of
  /// FCL's, and, with `solid`, for a mesh whose surface does not close.
  Part(const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose, Contact contact);

  bool isUnbounded() const { return unbounded_; }
  const UnboundedSet& unbounded() const { return half_space_; }

  bool isMesh() const { return mesh_; }

  /// Whether it counts as filled.
  bool isSolidMesh() const { return solid_; }

  /// As FCL has it: `cost_density` is at least `threshold_occupied`. Those of an octree do not
  /// count, its cells have occupancies of their own.
  bool isOccupied() const;

  /// Whether FCL passes it over beside an octree of more than one cell.
  bool isFree() const { return !octree_ && geometry_->isFree(); }

  bool isOctree() const { return octree_ != nullptr; }

  /// An octree of more than one cell.
  bool isDividedOctree() const;

  int pieceCount() const;
  ConvexSet piece(int i) const;

  /// Corner `corner` of a hull, in the world.
  ExactVector exactCorner(int piece, int corner) const;

  /// The same to 237 bits, relative to the reference.
  WideVector wideCorner(int piece, int corner) const;

  /// Bound on what that is rounded by, and the reference.
  const Wide& wideError() const { return wide_error_; }

  const std::vector<PieceNode>& nodes() const { return nodes_; }
  const WideVector& reference() const { return reference_; }

  /// Bound on the coordinates of its points relative to the reference.
  const LongVector& extent() const { return extent_; }

  /// Bound on the error of such a coordinate.
  const LongVector& error() const { return error_; }

  /// Vertices, one of every connected part; of a curved shape none: its reference is within.
  const std::vector<int>& representatives() const { return representatives_; }
  LongVector vertex(int i) const { return vertices_[static_cast<std::size_t>(i)]; }
  ExactVector exactVertex(int i) const;

  /// Whether two corners of a triangle have the same coordinates.
  bool hasEqualCorners(int triangle) const;

  /// Of a mesh: the corners of triangle `i`, in the order in which it has them.
  const int* triangle(int i) const { return &corners_[3 * static_cast<std::size_t>(i)]; }

 private:
  void readMesh();
  void readShape();
  void readCurved(CurvedShape::Kind kind, const Eigen::Vector3d& radii, double half_length);
  void addHull(const std::vector<Eigen::Vector3d>& corners);
  void addBox(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi);
  void addCells(const fcl::OcTreed::OcTreeNode* node, const fcl::AABBd& box);
  void placeUnbounded(const Eigen::Vector3d& normal, double offset, bool surface);
  void placeVertices();
  void connect();
  void checkClosed() const;
  void buildTree();
  int buildNode(std::vector<int>& order, int begin, int end, const std::vector<PieceBox>& boxes);

  const fcl::CollisionGeometryd* geometry_;
  Eigen::Matrix3d linear_;
  Eigen::Vector3d translation_;
  const fcl::OcTreed* octree_ = nullptr;
  bool mesh_ = false;
  bool solid_ = false;
  bool unbounded_ = false;
  bool curved_ = false;
  UnboundedSet half_space_;
  CurvedShape shape_;
  std::vector<Eigen::Vector3d> originals_;  // vertices in the frame of the geometry
  std::vector<LongVector> vertices_;        // the same in the world, relative to the reference
  std::vector<int> corners_;                // of all hulls, one after the other
  std::vector<int> first_corner_;           // of each hull, and one more
  std::vector<int> welded_;                 // of each vertex: the first of equal coordinates
  std::vector<int> representatives_;
  WideVector reference_;
  LongVector extent_ = LongVector::Zero();
  LongVector error_ = LongVector::Zero();
  Wide wide_error_ = 0;
  std::vector<PieceNode> nodes_;
};

}  // namespace oracle
