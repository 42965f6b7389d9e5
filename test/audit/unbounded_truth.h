// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Half-spaces and planes: only the displacement along their normal matters.
#pragma once

#include "line_contact.h"
#include "truth.h"

namespace fcl_prob_audit {

/// Of the standard normal distribution.
Exact normalMass(const Span<Exact>& span);

/// Of N(mean, deviation²); an indicator where the deviation is 0.
Exact massOfSpan(const Span<Exact>& span, const Exact& mean, const Exact& deviation);

/// One group has unbounded members only, the other none; otherwise nothing.
std::optional<Exact> unboundedProbability(const TruthQuestion& question, const Normal& normal,
                                          const std::array<Exact, 3>& shift);

}  // namespace fcl_prob_audit
