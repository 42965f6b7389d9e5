// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bounds on what lines along the first axis have of a convex mesh's C-obstacles with whole nodes.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "scene/whitened_fan.h"

namespace fcl_prob::detail {

/// Faces that are nearer to along the lines tell little of places on them.
inline constexpr double kLeastSlope = 1e-3;

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

/// P ⊕ the triangles of a node lies before and behind some planes along faces of P. All is certain.
class NodeSpans {
 public:
  /// Keeps a reference to the fan.
  explicit NodeSpans(const WhitenedFan& fan);

  /// What around() is asked of from now on.
  void lookAt(const Column& column);

  /// Around what the lines of the column have of P ⊕ the triangles of a node. Nothing if they miss
  /// it.
  std::optional<LineSpan> around(int node);

 private:
  // Measured on robot parts beside an arm. What is behind is mostly known from elsewhere.
  static constexpr int kFirstFaces = 24;
  static constexpr int kLastFaces = 8;
  static constexpr int kFaces = kFirstFaces + kLastFaces;

  /// By plane: those that lines enter by, where they do (y_0), then those that they leave by
  /// (-y_0). The larger, the more is told of a line.
  using Ends = Eigen::Array<float, kFaces, 1>;
  using Places = Eigen::Array<double, kFaces, 1>;

  void addFaces(double sign, int count, int place);
  Ends endsAt(const Eigen::Vector3d& vertex) const;
  void boundNodes();

  const WhitenedFan& fan_;
  // With P put to t, lines end at or after places_ + slopes_·t, less slopes_·(0, u_0, u_1).
  Eigen::Matrix<double, kFaces, 3> slopes_;
  Places places_;
  Places rounding_;  ///< of the lines
  Column column_;
  Ends shifts_;                 ///< of the ends, in the column
  std::vector<NodeBox> boxes_;  ///< around P ⊕ the triangles of all nodes, or none yet
  std::vector<Ends> ends_;      ///< of P put to those
};

}  // namespace fcl_prob::detail
