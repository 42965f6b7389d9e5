// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// P = E[P(contact | configuration)], estimated over random configurations.
#pragma once

#include <functional>

#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "fcl_prob/random_configuration.h"
#include "montecarlo/placement_collider.h"

namespace fcl_prob::detail {

/// The probability given a configuration, which leaves a translation; called from several threads.
using ConditionalAnswer =
    std::function<ProbabilityResult(const PlacedConfiguration&, const ProbabilityRequest&)>;

/// Draws until the standard error is within the tolerance: configurations in antithetic pairs, or
/// calls of fcl::collide at evenly spread points, whichever gets there sooner.
/// \param configuration  of dimension 1 at least
/// \param a, b           what the answers are about
ProbabilityResult configurationEstimate(const RandomConfiguration& configuration,
                                        const ConditionalAnswer& answer, const GeometryList& a,
                                        const GeometryList& b, const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
