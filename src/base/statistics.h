// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What several did for one answer.
#pragma once

#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// Adds what one of them did to what all of them did: counts are added up, of peaks the largest
/// counts, and rungs and times of one name are added up.
void addStatistics(const ProbabilityStatistics& one, ProbabilityStatistics& all);

}  // namespace fcl_prob::detail
