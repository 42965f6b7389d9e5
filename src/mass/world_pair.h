// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Two convex polytopes in world axes, and the faces of their C-obstacle, in more digits than
// doubles have.
#pragma once

#include <optional>
#include <vector>

#include "convex/pair_obstacle.h"
#include "gaussian/long_vector.h"

namespace fcl_prob::detail {

using LongPoints = std::vector<LongVector3>;

/// The hull of all differences b - a + origin of two sets of points.
struct DifferenceBody {
  LongPoints of_b, minus_a;
  LongVector3 origin;

  /// The largest n·y.
  long double reach(const LongVector3& direction) const;
};

/// B about its own origin, A reflected about its own.
struct WorldPair {
  LongPoints of_b, minus_a;
  LongVector3 origin;  ///< of B, seen from that of A displaced by the mean
  double slack;        ///< how far they may reach out of the hulls of their points (metres)
  double rounding;     ///< of a corner of the C-obstacle, also after whitening (metres)
};

/// \param inset  metres: by so much the bodies together may stay behind the polytopes; it counts as
///   rounding
WorldPair worldPair(const PairFrame& frame, const ConvexBody& a, const fcl::Transform3d& pose_a,
                    const ConvexBody& b, const fcl::Transform3d& pose_b,
                    const GaussianDisplacement& displacement, double inset);

/// The faces of a C-obstacle about the difference of the origins, whose corners are sums of two.
struct SummedFaces {
  FaceSet faces;
  LongPoints corners;
};

/// Nothing if rounding spoils them.
std::optional<SummedFaces> summedFaces(const PairFrame& frame, const ConvexBody& a,
                                       const ConvexBody& b, const Interruption& interruption);

}  // namespace fcl_prob::detail
