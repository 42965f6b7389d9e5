// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The certified interval of DESIGN section 4: a disjoint partition of the displacement space.
#pragma once

#include "cells/ball_truncation.h"
#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "scene/containment.h"
#include "scene/piece_tree.h"

namespace fcl_prob::detail {

/// Certified interval of the probability that `a`, displaced, meets `b`; with the request's method
/// `estimate` also an estimate; decision and gradient as the request asks. Poses must be
/// rigid and the request valid. Objects with a `solid` count as solids, others as surfaces.
///
/// With the request's bands the interval holds for all shapes within them; the objects may then
/// have no motion of their own. With sweeps of their parts `upper` is that of a contact for any of
/// the motions, `lower` that of a contact where the poses say; no estimate may then be asked for.
///
/// With a `ball` the interval is that of the probability of meeting and being within that ball of
/// the whitened frame at once; neither an estimate nor a gradient may then be asked for.
ProbabilityResult partitionProbability(const PartitionObject& a, const PartitionObject& b,
                                       const GaussianDisplacement& displacement,
                                       const ProbabilityRequest& request,
                                       const BallTruncation* ball = nullptr);

}  // namespace fcl_prob::detail
