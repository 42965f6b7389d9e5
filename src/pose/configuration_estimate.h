// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// P = E[P(contact | configuration)], estimated over random configurations.
#pragma once

#include <functional>

#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "fcl_prob/random_configuration.h"

namespace fcl_prob::detail {

/// The probability given a configuration, which leaves a translation; called from several threads.
using ConditionalAnswer =
    std::function<ProbabilityResult(const PlacedConfiguration&, const ProbabilityRequest&)>;

/// Configurations in antithetic pairs until the standard error is within the tolerance.
/// \param configuration  of dimension 1 at least
ProbabilityResult configurationEstimate(const RandomConfiguration& configuration,
                                        const ConditionalAnswer& answer,
                                        const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
