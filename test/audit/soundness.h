// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What has to hold of every answer by itself.
#pragma once

#include "ask.h"
#include "tally.h"

namespace fcl_prob_audit {

/// Probabilities in order, finite numbers; a status, a decision and counters that agree with the
/// request.
void checkSound(const Scene& scene, const Answer& answer, std::vector<Violation>& found);

}  // namespace fcl_prob_audit
