// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where a convex polytope can be for it to be within another one.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fcl_prob/convex_body.h"
#include "gaussian/long_vector.h"

namespace fcl_prob::detail {

/// The places y of the origin of one polytope, the guest, in the frame of another one, the host,
/// at which the guest is within the host: the intersection of n·y <= h(n) - g(n) over the faces'
/// normals n, with the heights h and g of host and guest. All that is said is certain.
class RoomWithin {
 public:
  /// \param host   the hull of points
  /// \param turn   from the frame of the guest to that of the host
  /// \param inset  metres: by so much the two bodies together may stay behind the polytopes
  RoomWithin(const ConvexBody& host, const ConvexBody& guest, const LongMatrix3& turn,
             double inset);

  /// Whether the guest is too wide for the host along some normal: there is no room.
  bool isEmpty() const { return is_empty_; }

  /// A polytope around the room, for the smallest guest and the whole host; nothing if none was
  /// found.
  std::optional<ConvexBody> around() const;

  /// A polytope within the room, for the whole guest and the smallest host; nothing if none was
  /// found.
  std::optional<ConvexBody> inside() const;

 private:
  struct Side {
    Eigen::Vector3d normal;
    long double most;   ///< of normal·y where bodies may be within each other
    long double least;  ///< what is below that of all sides is room
  };

  std::vector<Eigen::Vector3d> corners(bool around, long double moved) const;
  bool holdsRoom(const ConvexBody& body) const;
  bool isRoom(const std::vector<Eigen::Vector3d>& points) const;

  std::vector<Side> sides_;
  double size_;
  long double rounding_;  ///< of a height
  bool is_empty_ = false;
};

}  // namespace fcl_prob::detail
