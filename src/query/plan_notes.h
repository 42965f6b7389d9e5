// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the plan says besides how a pair was answered: the tolerance that was reached, units that
// may be wrong.
#pragma once

#include <optional>
#include <string>
#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "query/prepared_geometry.h"

namespace fcl_prob::detail {

/// Says so in the plan where an answer has converged by the absolute tolerance only: its interval,
/// or its standard error, may then be as large as P itself.
void noteTolerance(const ProbabilityRequest& request, ProbabilityResult& result);

/// Words for the plan where a mesh is a thousand times longer than the other one, where the
/// deviations are a thousand times longer than both, or where they are 1e-4 of a mesh (1 mm beside
/// 1 m is usual). Nothing for shapes that are no meshes: their lengths are written by hand.
std::optional<std::string> sizeNote(const PreparedGeometry& a, const PreparedGeometry& b,
                                    const GaussianDisplacement& displacement);

}  // namespace fcl_prob::detail
