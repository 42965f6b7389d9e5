// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where a line through the displacement space is within the C-obstacles of two objects. Nothing of
// it is certified: it is for estimates.
#pragma once

#include <optional>
#include <vector>

#include "scene/obstacle_table.h"

namespace fcl_prob::detail {

/// Where a line enters or leaves the union of all C-obstacles, or is left.
struct LineEnd {
  double at;                                         ///< along the line, in its direction's length
  NodePair leaves{-1, -1};                           ///< of the C-obstacle that ends there
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< its own, outward; 0 where the line is left
};

/// A stretch of the line on which surfaces touch.
struct LineStretch {
  LineEnd from;
  LineEnd to;
};

class LineCrossings {
 public:
  /// Keeps a reference.
  explicit LineCrossings(const WhitenedPair& pair) : pair_(pair), obstacles_(pair) {}

  /// All stretches within kReach of the line's origin, in order, none of which meet: valid until
  /// the next call. \param direction  unit
  const std::vector<LineStretch>& on(const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction);

  /// The point of A that touches B at an end of a stretch.
  Eigen::Vector3d touchingPointOfA(const LineEnd& end) const;

 private:
  std::optional<LineStretch> clipped(const NodeBox& box) const;
  void clip(NodePair leaves);
  void clipCurved();
  std::optional<LineStretch> clippedBySlabs(const SlabArrays& slabs, NodePair leaves) const;
  std::optional<LineStretch> clippedBySupport(const LineStretch& within) const;
  std::optional<double> placeInside(const SupportObstacle& obstacle, double lo, double hi) const;
  std::optional<LineEnd> leaving(const SupportObstacle& obstacle, double from, double sign,
                                 NodePair leaves) const;
  bool isKnown(const LineStretch& stretch) const;
  void add(const LineStretch& stretch);
  Eigen::Vector3d pointAt(double s) const { return origin_ + s * direction_; }

  const WhitenedPair& pair_;
  ObstacleTable obstacles_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_ = Eigen::Vector3d::UnitX();
  std::vector<LineStretch> stretches_;
  std::vector<LineStretch> curved_;  ///< around what curved C-obstacles may have of the line
  std::vector<NodePair> stack_;
  TriangleSlabsData once_;
};

}  // namespace fcl_prob::detail
