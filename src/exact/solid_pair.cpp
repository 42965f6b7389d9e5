// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/solid_pair.h"

#include <Eigen/LU>

#include "convex/room_within.h"
#include "exact/convex_pair_mass.h"

namespace fcl_prob::detail {
namespace {

LongMatrix3 turnFrom(const Eigen::Matrix3d& guest, const Eigen::Matrix3d& host) {
  if (guest == host) return LongMatrix3::Identity();
  const LongMatrix3 back = host.cast<long double>().inverse();
  return back * guest.cast<long double>();
}

}  // namespace

Bounds solidPairMass(const PlacedSolid& a, const PlacedSolid& b,
                     const GaussianDisplacement& displacement, const Interruption& interruption) {
  return convexPairMass(a.solid.hull, a.pose, b.solid.hull, b.pose, displacement, interruption,
                        a.solid.inset + b.solid.inset);
}

/// That of the room for the guest's origin, beside which the guest is a point.
Bounds containedMass(Guest guest, const PlacedSolid& a, const PlacedSolid& b,
                     const GaussianDisplacement& displacement, const Interruption& interruption) {
  const bool is_a = guest == Guest::a;
  const PlacedSolid &inner = is_a ? a : b, &outer = is_a ? b : a;
  const RoomWithin room(outer.solid.hull, inner.solid.hull,
                        turnFrom(inner.pose.linear(), outer.pose.linear()),
                        a.solid.inset + b.solid.inset);
  if (room.isEmpty()) return {0.0, 0.0};
  const ConvexSolid origin{ConvexBody(std::vector{Eigen::Vector3d(Eigen::Vector3d::Zero())}), 0.0};
  const auto massOfRoom = [&](const ConvexBody& polytope) {
    const ConvexSolid in_room{polytope, 0.0};
    if (is_a) return solidPairMass({origin, a.pose}, {in_room, b.pose}, displacement, interruption);
    return solidPairMass({in_room, a.pose}, {origin, b.pose}, displacement, interruption);
  };
  const auto around = room.around(), inside = room.inside();
  return {inside ? massOfRoom(*inside).lower : 0.0, around ? massOfRoom(*around).upper : 1.0};
}

}  // namespace fcl_prob::detail
