// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The colours of exported scenes.
#pragma once

#include "cli/gltf_file.h"

namespace fcl_prob::cli {

/// From grey (0) through yellow to red (1). The root makes small likelihoods visible.
Colour heat(double likelihood);

/// Of what is touched, and is not itself coloured by how likely that is.
Colour touchedColour();

/// Of the ellipsoid of so many standard deviations: the larger, the fainter.
Colour ellipsoidColour(int deviations);

}  // namespace fcl_prob::cli
