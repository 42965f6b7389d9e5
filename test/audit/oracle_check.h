// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Scenes before the oracle: what the partition claims of its cells, and how often random
// displacements touch.
#pragma once

#include "ask.h"
#include "tally.h"
#include "truth.h"

namespace fcl_prob_audit {

/// Asks the scene's question and checks some of what the partition claims meanwhile, point by
/// point. Whatever is claimed wrongly is a violation "claim: METHOD".
/// \param truth  the scene as it is, of which `scene` is a model with bands
Answer askCheckingClaims(const Scene& scene, const Scene& truth, FamilyTally& tally,
                         std::vector<Violation>& found);

/// Displacements drawn and put to the oracle: for shapes that no line can be laid through. Nothing
/// where the oracle has no answer.
std::optional<SampledTruth> hitsOfOracle(const Scene& scene, int samples);

}  // namespace fcl_prob_audit
