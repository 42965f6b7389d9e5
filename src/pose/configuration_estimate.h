// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// P = E[P(contact | configuration)], estimated over random configurations.
#pragma once

#include "pose/configuration_mixture.h"
#include "pose/pair_source.h"
#include "sampling/placement_collider.h"

namespace fcl_prob::detail {

/// Draws until the standard error is within the tolerance or, with a threshold, until it is decided
/// with the confidence that the request states, whatever the distribution: by calls of fcl::collide
/// where it can be asked and the limits are enough, else by answers at configurations in antithetic
/// pairs. A gradient is always that of such pairs.
/// \param mixture  of dimension 1 at least
/// \param a, b     what the answers are about
ProbabilityResult configurationEstimate(const ConfigurationMixture& mixture,
                                        const ConditionalAnswer& answer, const GeometryList& a,
                                        const GeometryList& b, const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
