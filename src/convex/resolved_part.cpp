// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/resolved_part.h"

#include "base/constants.h"
#include "convex/slab_kernels.h"

namespace fcl_prob::detail {

ResolvedPart resolvedPart(const GaussianDisplacement& displacement, double size) {
  ResolvedPart resolved{displacement};
  for (int rank = displacement.rank(); rank > 0; --rank) {
    const double deviation = displacement.standardDeviations()[rank - 1];
    const double moved = (1.0 + 4 * kEpsilon) * kReach * deviation;
    if (!(moved <= kEpsilon * size)) break;
    resolved.displacement = resolved.displacement.withoutLastAxis();
    resolved.left_out += moved;
  }
  return resolved;
}

}  // namespace fcl_prob::detail
