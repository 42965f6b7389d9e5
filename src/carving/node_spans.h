// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bounds on what lines along the first axis have of a convex mesh's C-obstacles with whole nodes.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "pieces/whitened_fan.h"

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

  /// The planes that lines enter by (sign 1), or leave by (-1): of either kind sign·y_0 is the
  /// larger, the later they do.
  template <int count>
  struct Side {
    using Ends = Eigen::Array<double, count, 1>;

    std::vector<int> faces;
    Ends shifts;  ///< of the ends, in the column
  };

  using First = Side<kFirstFaces>;
  using Last = Side<kLastFaces>;

  struct NodeEnds {
    NodeBox box;
    First::Ends first;  ///< where the line through the origin passes the planes
    Last::Ends last;
  };

  std::vector<int> facesTowards(double sign, int count) const;
  template <int count>
  void look(const Column& column, Side<count>& side) const;
  template <int count>
  std::vector<Eigen::Array<double, count, 1>> endsAtVertices(const Side<count>& side,
                                                             double nothing) const;
  void boundNodes();

  const WhitenedFan& fan_;
  double rounding_;
  First first_;
  Last last_;
  Column column_;
  std::vector<NodeEnds> nodes_;  ///< all, or none yet
};

}  // namespace fcl_prob::detail
