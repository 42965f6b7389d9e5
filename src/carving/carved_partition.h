// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The partition of the displacement space where one of two meshes is convex.
#pragma once

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "fcl_prob/whitening.h"
#include "pieces/containment.h"
#include "pieces/partition_object.h"
#include "pieces/whitened_tree.h"

namespace fcl_prob::detail {

/// Whether carve() is for such a query.
bool mayBeCarved(const PartitionObject& a, const PartitionObject& b,
                 const GaussianDisplacement& displacement, const ProbabilityRequest& request);

/// As partitionProbability(), but for the decision, where mayBeCarved(). False where that does not
/// reach what the request asks for, so that the boxes of the other partition are to be tried: the
/// interval, if there is one, and the statistics are then those so far.
/// \param pair    in the frame of `whitening`; its first axis had best be across the nearest
/// contact \param solids  null: surfaces
bool carve(const PartitionObject& a, const PartitionObject& b,
           const GaussianDisplacement& displacement, const Whitening& whitening,
           const WhitenedPair& pair, const SolidContact* solids, const ProbabilityRequest& request,
           ProbabilityResult& result);

}  // namespace fcl_prob::detail
