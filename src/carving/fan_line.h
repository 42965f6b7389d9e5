// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where lines along the first axis are within the C-obstacles of a convex mesh, taken whole.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "pieces/whitened_fan.h"

namespace fcl_prob::detail {

/// A part of a line: lo <= y_0 <= hi.
struct LineSpan {
  double lo;
  double hi;
};

/// A rectangle across the first axis, [lo, hi], and all that is before and behind it.
struct Column {
  Eigen::Vector2d lo;
  Eigen::Vector2d hi;
};

/// Lines { (s, u_0, u_1) } against P ⊕ T. Nothing of where they enter and leave it is certified: it
/// is for estimates. Bounds around whole boxes of the mesh are.
class FanLine {
 public:
  /// Keeps a reference to the fan.
  explicit FanLine(const WhitenedFan& fan);

  /// What around() is asked of from now on.
  void lookAt(const Column& column);

  /// Around what the lines of the column have of P ⊕ a node's box of the mesh: certain. Nothing if
  /// they miss it.
  std::optional<LineSpan> around(int node);

  /// What all lines of the column have of P put to a point of T: certain.
  std::optional<LineSpan> within(const Eigen::Vector3d& point) const;

  /// The least sign·s for which (s, u_0, u_1) is in P ⊕ T; nothing if there is none below a limit.
  /// \param corners  of T, columns
  std::optional<double> first(const Eigen::Matrix3d& corners, const Eigen::Vector2d& u, double sign,
                              double limit);

  /// After first(): the largest s for which (s, u_0, u_1) is in P put to where T was touched.
  double endBehindFirst() const;

  /// After first(): that point of T.
  Eigen::Vector3d touchedPoint(const Eigen::Vector2d& u) const {
    return Eigen::Vector3d(0.0, u[0], u[1]) - touched_;
  }

 private:
  // Measured on robot parts beside an arm: 8, 12 and 16.
  static constexpr std::size_t kClippingFaces = 12;

  using OfClippingFaces = std::array<double, kClippingFaces>;

  /// P ⊕ a node's box: its own box, and where it ends by the clipping faces on the line through the
  /// origin.
  struct NodeEnds {
    NodeBox box;
    OfClippingFaces ends;
  };

  /// Faces that planes of C-obstacles were last found at, behind the one that faces the lines most.
  struct Starts {
    std::vector<int> faces;
    std::size_t oldest = 1;
  };

  void chooseClippingFaces();
  const NodeEnds& endsOf(int node);
  int startFor(const Eigen::Matrix3d& corners, const Eigen::Vector2d& u, double sign) const;
  void remember(int face, double sign);
  int highestFace(const Eigen::Vector3d& point);

  const WhitenedFan& fan_;
  std::vector<Eigen::Vector3d> faces_;  ///< d: P is where d·y <= 1 for all of them
  std::vector<int> neighbours_;         ///< of all faces
  std::vector<int> neighbours_begin_;   ///< of each of them, and the end
  std::array<Starts, 2> starts_;        ///< for lines from above and from below
  std::vector<int> clipping_;           ///< by rising first coordinate, far from 0
  std::size_t clipping_below_ = 0;      ///< so many of them are below P
  double rounding_;
  std::vector<int> looked_at_;  ///< of all nodes, where among the ends they are; -1: not yet
  std::vector<NodeEnds> ends_;
  Column column_;
  OfClippingFaces shifts_{};  ///< of the ends, in the column
  int highest_ = 0;           ///< that was found last
  Eigen::Vector3d touched_;   ///< (0, u_0, u_1) less the point of T
};

}  // namespace fcl_prob::detail
