// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mixture from the answers for its components.
#pragma once

#include <functional>

#include "fcl_prob/mixture.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// A query of one Gaussian.
using GaussianQuery =
    std::function<ProbabilityResult(const GaussianDisplacement&, const ProbabilityRequest&)>;

/// The weighted sum of what `query` answers for the components. Tolerance, threshold, limits and
/// progress are those of the sum. The request must be valid.
ProbabilityResult mixtureProbability(const GaussianMixture& mixture,
                                     const ProbabilityRequest& request, const GaussianQuery& query);

}  // namespace fcl_prob::detail
