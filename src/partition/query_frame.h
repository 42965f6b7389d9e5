// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The frame in which a pair of objects is divided into cells.
#pragma once

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/whitening.h"
#include "pieces/whitened_tree.h"

namespace fcl_prob::detail {

/// The whitened frame with its first axis along the direction of closest approach, so that the
/// boundary of the C-obstacle lies across one axis of the cells. The objects are in it with the
/// bands of the request, or the sweeps of their parts.
struct QueryFrame {
  Whitening whitening;
  WhitenedPair pair;
};

/// \throws InvalidRequest for bands around objects that move by themselves
QueryFrame queryFrame(const PartitionObject& a, const PartitionObject& b,
                      const GaussianDisplacement& displacement, const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
