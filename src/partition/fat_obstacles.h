// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The C-obstacles of one convex mesh, taken whole, and the triangles of another mesh.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "partition/convex_fan.h"
#include "partition/whitened_tree.h"

namespace fcl_prob::detail {

/// A plane of a C-obstacle V in the whitened frame: V lies in { n·y <= outer }, |n| = 1. What lies
/// in { n·y <= outer - margin } for all planes of V belongs to V.
struct ObstaclePlane {
  Eigen::Vector3d n;
  double outer;
  double margin;

  double inner() const { return outer - margin; }
};

/// V_t = P ⊕ T_t for every triangle t of the mesh (docs/rounding.md tells what its planes are):
/// planes across the normals of P, offset by the triangle's extent, are shared by all; those across
/// an edge of the triangle and one of P, and the triangle's own, are made when they are first asked
/// for. All is relative to the centre of P, which is within P.
class FatObstacles {
 public:
  /// \param part      of the tree of the object whose members are convex; has a fan
  /// \param fan_is_a  whether A is that object, and B the mesh
  /// \param linear    from the frame of the part to the whitened one, as the tree was moved
  FatObstacles(const WhitenedPair& pair, const PieceTree::Part& part, bool fan_is_a,
               const Eigen::Matrix3d& linear);

  /// Of one of so many triangles that has not been asked for anything.
  static std::size_t leastMemory(std::size_t triangles) {
    return triangles * sizeof(std::unique_ptr<Details>);
  }

  /// Whether everything was accurate enough to be certified.
  bool usable() const { return usable_; }

  /// Planes across the normals of P.
  int faceCount() const { return static_cast<int>(normals_.size()); }
  const Eigen::Vector3d& faceNormal(int face) const { return normals_[face]; }

  /// Certainly not below n·y on P.
  double support(const Eigen::Vector3d& n) const;

  /// The same on V_t where it is `of_p` on P.
  double support(int triangle, const Eigen::Vector3d& n, double of_p) const;

  /// The largest n·y on T_t, of which V_t = P ⊕ T_t.
  double extent(int triangle, const Eigen::Vector3d& n) const {
    const Eigen::Matrix3d t = corners(triangle);
    return std::max({n.dot(t.col(0)), n.dot(t.col(1)), n.dot(t.col(2))});
  }

  ObstaclePlane facePlane(int triangle, int face) const;

  /// The offsets of the face planes of V_t (see ObstaclePlane::outer), without what is added for
  /// rounding.
  const std::vector<double>& faceOffsets(int triangle);

  /// All other planes.
  const std::vector<ObstaclePlane>& otherPlanes(int triangle);

  /// Not below the margin of any face plane of V_t.
  double mostMargin(int triangle) const { return most_margin_ + details_[triangle]->loss; }

  /// Whether a triangle or an edge turned out too degenerate for anything to be said of what its
  /// obstacle contains.
  bool failed() const { return failed_; }

  /// What is added to an offset for rounding.
  double padding(const Eigen::Vector3d& n) const { return n.cwiseAbs().dot(pad_); }

  /// Whether no connected part of the mesh fits within P, so that where triangles meet P they meet
  /// its surface.
  bool isTooSmallFor(const std::vector<std::pair<int, int>>& spans) const;

  /// Box of P ⊕ a box of the tree of the mesh.
  NodeBox obstacleBox(int node) const;
  const WhitenedTree& mesh() const { return mesh_; }

  /// In which half of the doubled middle of T ⊕ P: a point of V_t.
  Eigen::Vector3d middle(int triangle) const { return corners(triangle).rowwise().mean(); }

  std::size_t memory() const { return memory_; }
  std::size_t built() const { return built_; }

 private:
  struct Details {
    std::vector<double> offsets;
    std::vector<ObstaclePlane> planes;
    bool has_planes = false;
    double loss = 0.0;  ///< added to all margins
  };

  void moveFan(const WhitenedTree& body, const PieceTree::Part& part,
               const Eigen::Matrix3d& linear);
  Eigen::Matrix3d corners(int triangle) const;
  Details& details(int triangle);
  void buildPlanes(int triangle, Details& into);
  void addTriangleNormal(const Eigen::Matrix3d& corners, Details& into) const;
  void addEdge(const Eigen::Matrix3d& corners, int edge, Details& into);
  ObstaclePlane planeAcross(const Eigen::Matrix3d& corners, const Eigen::Vector3d& n,
                            double of_p) const;

  const WhitenedTree& mesh_;
  double sign_;  ///< of the mesh's vertices: 1 if A is the convex object
  bool usable_ = true;
  Eigen::Vector3d centre_;               ///< of the convex object, whitened
  std::vector<Eigen::Vector3d> points_;  ///< of P, relative to its centre
  std::vector<Eigen::Vector3d> normals_;
  std::vector<double> offsets_;  ///< of P, certified
  std::vector<std::pair<int, int>> arcs_;
  std::vector<double> pads_;     ///< of every face
  std::vector<double> margins_;  ///< of every face, without a triangle's loss
  bool failed_ = false;
  double most_margin_ = 0.0;
  double share_ = 0.0;  ///< margins are this share of P's offset
  double reach_ = 0.0;  ///< bound on |y - v| for any y of a cell and any v of a V_t
  Eigen::Vector3d pad_;
  NodeBox box_;  ///< of P, centred
  std::vector<std::unique_ptr<Details>> details_;
  std::vector<double> along_;  // of an edge, on every normal
  std::size_t memory_ = 0;
  std::size_t built_ = 0;
};

}  // namespace fcl_prob::detail
