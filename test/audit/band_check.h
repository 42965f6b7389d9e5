// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bands: what is said of a model with bands must hold for shapes that are off by as much.
#pragma once

#include "scene.h"
#include "tally.h"

namespace fcl_prob_audit {

/// Gives the scene bands, moves the surfaces of its shapes within them, and puts the claims of the
/// query for the model before the oracle for the moved shapes. Nothing where the scene's shapes are
/// not of a kind that is moved here.
void checkBands(const Scene& scene, Tally& tally, std::vector<Violation>& found);

}  // namespace fcl_prob_audit
