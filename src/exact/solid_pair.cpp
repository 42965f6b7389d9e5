// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/solid_pair.h"

#include <Eigen/LU>

#include "base/agreed_bounds.h"
#include "convex/room_within.h"
#include "exact/convex_pair_mass.h"
#include "exact/polytope_pair.h"

namespace fcl_prob::detail {
namespace {

LongMatrix3 turnFrom(const Eigen::Matrix3d& guest, const Eigen::Matrix3d& host) {
  if (guest == host) return LongMatrix3::Identity();
  const LongMatrix3 back = host.cast<long double>().inverse();
  return back * guest.cast<long double>();
}

}  // namespace

/// With corners to more digits, else with what doubles are rounded by, which the insets are within.
Bounds solidPairMass(const PlacedSolid& a, const PlacedSolid& b,
                     const GaussianDisplacement& displacement, const Interruption& interruption) {
  constexpr double kEnough = 1e-9;
  Bounds known{0.0, 1.0};
  const ConvexBody &of_a = a.solid.hull, &of_b = b.solid.hull;
  const double inset = a.solid.inset + b.solid.inset;
  if (displacement.rank() == 3) {
    const auto both =
        polytopePairMass(of_a, a.pose, of_b, b.pose, displacement, false, interruption, inset);
    if (both) known = both->mass;
    if (known.width() <= kEnough * known.upper) return known;
  }
  return agreed(known,
                convexPairMass(of_a, a.pose, of_b, b.pose, displacement, interruption, inset));
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
