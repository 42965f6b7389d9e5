// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where a C-obstacle is cut by the plane or the line in which the displacement moves.
#pragma once

#include <optional>

#include "exact/convex_bracket.h"
#include "exact/principal_obstacle.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// A point of a section, which up to error() is in it, and a line that it does not cross: normal·x
/// <= offset, rounding included. Both are next to each other if the search converged, and hold in
/// any case.
struct SectionTouch {
  Eigen::Vector2d normal, point;
  double offset;
  double across, bend;  ///< third component of the plane's normal, and what the next search uses
};

/// A point that is inside a section by a distance, in space.
struct PointWithin {
  Eigen::Vector2d point;
  double distance;  ///< not positive if nothing is known
};

/// Whether a set is met by a plane or a line.
enum class Meeting { none, unknown, inside };

/// The section with the plane of the first two principal axes. As its support function is the least
/// of those of the obstacle over all normals with the same part in the plane, any of them bounds
/// it, and two support points on either side of the plane have a point of the section between them.
class PrincipalSection {
 public:
  explicit PrincipalSection(const PrincipalObstacle& obstacle);

  Meeting meeting() const { return meeting_; }

  /// Farthest along a direction in the plane (about of length 1), with a gap of about `tolerance`.
  /// Nothing if the search leads nowhere.
  /// \param across, bend  of a neighbour; 0 if there is none
  std::optional<SectionTouch> touch(const Eigen::Vector2d& direction, double tolerance,
                                    double across = 0.0, double bend = 0.0) const;

  /// A point of the section, if it is met inside.
  const PointWithin& within() const { return within_; }

  /// How far points of touch() may be from the obstacle.
  double error() const { return error_; }

  const PrincipalObstacle& obstacle() const { return obstacle_; }

 private:
  const PrincipalObstacle& obstacle_;
  double height_;  ///< of the plane
  double error_;
  PointWithin within_{Eigen::Vector2d::Zero(), 0.0};
  Meeting meeting_;
};

/// The obstacle along the first principal axis, about its own origin. Between the ends of `inner`
/// all is within it, and all of it is between those of `outer`.
struct AxisSection {
  Meeting meeting = Meeting::unknown;
  Bounds inner{0.0, 0.0}, outer{0.0, 0.0};
};

AxisSection axisSection(const PrincipalSection& section);

}  // namespace fcl_prob::detail
