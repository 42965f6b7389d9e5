// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A convex mesh or polytope, taken whole, in the whitened frame of one query.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <utility>
#include <vector>

#include "scene/convex_fan.h"
#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// P, so that the C-obstacle of that mesh and a triangle T of the other one is P ⊕ T. All is
/// relative to the centre of P, which is within P; P and T are turned over where they have to be.
///
/// P lies in { n·y <= offset } of every face; what lies in { n·y <= offset + pad - margin } of all
/// of them belongs to P (docs/rounding.md).
class WhitenedFan {
 public:
  /// \param part      of the tree of the object whose members are taken whole
  /// \param fan       its own, or a body in or around it
  /// \param fan_is_a  whether A is that object, and B the mesh beside it
  /// \param linear    from the frame of the part to the whitened one, as the tree was moved
  WhitenedFan(const WhitenedPair& pair, const PieceTree::Part& part, const ConvexFan& fan,
              bool fan_is_a, const Eigen::Matrix3d& linear);

  /// Whether everything was accurate enough to be certified.
  bool usable() const { return usable_; }

  int faceCount() const { return static_cast<int>(normals_.size()); }
  const Eigen::Vector3d& faceNormal(int face) const { return normals_[face]; }
  double faceOffset(int face) const { return offsets_[face]; }
  Eigen::Map<const Eigen::VectorXd> offsets() const { return {offsets_.data(), faceCount()}; }

  /// n·y for every face.
  auto heightsAlong(const Eigen::Vector3d& y) const {
    return coordinates_.col(0) * y.x() + coordinates_.col(1) * y.y() + coordinates_.col(2) * y.z();
  }

  /// The largest n·y for every face in a box around 0 of such half sides.
  auto radiiOf(const Eigen::Vector3d& half) const {
    return coordinates_.col(0).cwiseAbs() * half.x() + coordinates_.col(1).cwiseAbs() * half.y() +
           coordinates_.col(2).cwiseAbs() * half.z();
  }

  double facePad(int face) const { return pads_[face]; }
  double faceMargin(int face) const { return margins_[face]; }

  /// Certainly not below n·y on P.
  double support(const Eigen::Vector3d& n) const;

  /// Pairs of faces: all neighbours, perhaps others.
  const std::vector<std::pair<int, int>>& arcs() const { return arcs_; }

  /// Around P.
  const NodeBox& box() const { return box_; }

  /// What is added to an offset for rounding.
  double padding(const Eigen::Vector3d& n) const { return n.cwiseAbs().dot(pad_); }
  const Eigen::Vector3d& pad() const { return pad_; }

  /// The other mesh: T has these corners.
  const WhitenedTree& mesh() const { return mesh_; }
  Eigen::Matrix3d corners(int triangle) const;
  Eigen::Vector3d corner(int vertex) const { return sign_ * (mesh_.vertices[vertex] - centre_); }

  /// Box of the corners of what is in a box of the tree of the mesh.
  NodeBox cornerBox(const NodeBox& of_mesh) const;

  /// Bound on |y - v| for any y of a cell and any v of a P ⊕ T.
  double reach() const { return reach_; }

  /// The largest n·y on T_t.
  double extent(int triangle, const Eigen::Vector3d& n) const {
    const Eigen::Matrix3d t = corners(triangle);
    return std::max({n.dot(t.col(0)), n.dot(t.col(1)), n.dot(t.col(2))});
  }

  /// Box of P ⊕ a box of the tree of the mesh.
  NodeBox obstacleBox(int node) const { return obstacleBox(mesh_.boxOf(node)); }
  NodeBox obstacleBox(const NodeBox& of_mesh) const;

  /// Whether no connected part of the mesh fits within P, so that where triangles meet P they meet
  /// its surface.
  bool isTooSmallFor(const std::vector<std::pair<int, int>>& spans) const;

 protected:
  const std::vector<Eigen::Vector3d>& normals() const { return normals_; }
  double sign() const { return sign_; }
  /// Margins are this share of P's offset.
  double share() const { return share_; }

  /// Not below any face's margin.
  double largestMargin() const { return most_margin_; }

  /// Not below the radius of a ball around 0 that holds P over that of one that P holds.
  double roundness() const { return roundness_; }

 private:
  void measureRoundness();
  void moveFan(const WhitenedTree& body, const PieceTree::Part& part, const ConvexFan& fan,
               const Eigen::Matrix3d& linear);

  const WhitenedTree& mesh_;
  double sign_;  ///< of the mesh's vertices: 1 if A is the convex object
  bool usable_ = true;
  Eigen::Vector3d centre_;               ///< of the convex object, whitened
  std::vector<Eigen::Vector3d> points_;  ///< of P
  std::vector<Eigen::Vector3d> normals_;
  Eigen::Matrix<double, Eigen::Dynamic, 3> coordinates_;  ///< the normals once more, by axis
  std::vector<double> offsets_;
  std::vector<std::pair<int, int>> arcs_;
  std::vector<double> pads_;
  std::vector<double> margins_;
  double most_margin_ = 0.0;
  double roundness_ = 0.0;
  double share_ = 0.0;
  double reach_ = 0.0;
  Eigen::Vector3d pad_;
  NodeBox box_;
};

}  // namespace fcl_prob::detail
