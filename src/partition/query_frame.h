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
  /// What the cells are of: the displacement without the axes along which all of it is less than
  /// what positions are rounded by. No cell could tell anything along those. How far it moves along
  /// them is part of the errors of `pair`, so that what is claimed holds wherever on them A is.
  GaussianDisplacement displacement;

  Whitening whitening;  ///< of that
  WhitenedPair pair;
};

/// \param all_axes  no axis is left out: for cells within a ball of the whitened frame
/// \throws InvalidRequest for bands around objects that move by themselves
///         InvalidDistribution if all axes are needed and lengths overflow along one of them
QueryFrame queryFrame(const PartitionObject& a, const PartitionObject& b,
                      const GaussianDisplacement& displacement, const ProbabilityRequest& request,
                      bool all_axes = false);

}  // namespace fcl_prob::detail
