// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where lines along the first axis meet what of a nearly convex mesh its core does not hold.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "geometry/box_tree.h"
#include "lines/fan_line.h"
#include "lines/node_spans.h"
#include "scene/nearly_convex.h"
#include "scene/whitened_fan.h"

namespace fcl_prob::detail {

/// The pieces D_i of the shell against triangles T of the other mesh: lines against D_i ⊕ T.
/// Nothing of it is certified: it is for estimates. What it needs is made when it is first asked.
class ShellLines {
 public:
  /// Keeps references to all but the matrix.
  /// \param core    that of the mesh, whitened; what is told is relative to its centre
  /// \param linear  from the frame of the part to the whitened one
  ShellLines(const WhitenedPair& pair, const PieceTree::Part& part, bool fan_is_a,
             const Eigen::Matrix3d& linear, const WhitenedFan& core);

  /// A piece, and around what the line has of D_i ⊕ T.
  struct Near {
    int piece;
    LineSpan span;
  };

  /// Pieces that the line at u may meet within gaps, those it may meet first before the others.
  const std::vector<Near>& near(int triangle, const Eigen::Vector2d& u,
                                const std::vector<LineSpan>& gaps);

  FanLine& lineOf(int piece);

  /// From a point of T as the line of a piece has it to where it is relative to the core's centre.
  Eigen::Vector3d shiftOf(int piece) const { return -shapes_[piece].shift; }

 private:
  /// A tetrahedron, relative to the centre of the core.
  struct Shape {
    Eigen::Vector3d shift;  ///< of its own centre
    std::vector<Eigen::Vector3d> normals;
    std::vector<double> offsets;
  };

  struct Solver {
    WhitenedFan fan;
    FanLine line;

    explicit Solver(WhitenedFan whitened) : fan(std::move(whitened)), line(fan) {}
    Solver(const Solver&) = delete;
    Solver& operator=(const Solver&) = delete;
  };

  void addShapes();
  BoxTree::Box addShape(const ConvexFan& piece);
  LineSpan spanOf(const Shape& shape, const Eigen::Matrix3d& corners,
                  const Eigen::Vector2d& u) const;

  const WhitenedPair& pair_;
  const PieceTree::Part& part_;
  bool fan_is_a_;
  Eigen::Matrix3d linear_;
  const WhitenedFan& core_;
  std::vector<Shape> shapes_;                     ///< of all pieces, or none yet
  BoxTree boxes_;                                 ///< of the shapes
  std::vector<std::unique_ptr<Solver>> solvers_;  ///< of those that were asked for
  std::vector<Near> near_;
};

}  // namespace fcl_prob::detail
