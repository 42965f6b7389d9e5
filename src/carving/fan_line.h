// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where lines along the first axis are within the C-obstacles of a convex mesh, taken whole.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "carving/node_spans.h"
#include "pieces/whitened_fan.h"

namespace fcl_prob::detail {

/// Lines { (s, u_0, u_1) } against P ⊕ T. Nothing of where they enter and leave it is certified: it
/// is for estimates. Bounds around whole boxes of the mesh are.
class FanLine {
 public:
  /// Keeps a reference to the fan.
  explicit FanLine(const WhitenedFan& fan);

  /// What around() is asked of from now on.
  void lookAt(const Column& column) { nodes_.lookAt(column); }

  /// Around what the lines of the column have of P ⊕ the triangles of a node: certain. Nothing if
  /// they miss it.
  std::optional<LineSpan> around(int node) { return nodes_.around(node); }

  /// The least sign·s for which (s, u_0, u_1) is in P ⊕ T; nothing if there is none below a limit.
  /// \param corners  of T, columns
  std::optional<double> first(const Eigen::Matrix3d& corners, const Eigen::Vector2d& u, double sign,
                              double limit);

  /// After first(): the largest s for which (s, u_0, u_1) is in P put to where T was touched.
  double endBehindFirst();

  /// After first(): that point of T.
  Eigen::Vector3d touchedPoint(const Eigen::Vector2d& u) const {
    return Eigen::Vector3d(0.0, u[0], u[1]) - touched_;
  }

 private:
  /// Faces that planes of C-obstacles were last found at, behind the one that faces the lines most.
  struct Starts {
    std::vector<int> faces;
    std::size_t oldest = 1;
  };

  int startFor(const Eigen::Matrix3d& corners, const Eigen::Vector2d& u, double sign) const;
  void remember(int face, double sign);
  int highestFace(const Eigen::Vector3d& point, double sign);

  const WhitenedFan& fan_;
  std::vector<Eigen::Vector3d> faces_;  ///< d: P is where d·y <= 1 for all of them
  std::vector<int> neighbours_;         ///< of all faces
  std::vector<int> neighbours_begin_;   ///< of each of them, and the end
  std::array<Starts, 2> starts_;        ///< for lines from above and from below
  NodeSpans nodes_;
  std::array<int, 2> highest_{};  ///< faces that were found last, from above and from below
  Eigen::Vector3d touched_;       ///< (0, u_0, u_1) less the point of T
};

}  // namespace fcl_prob::detail
