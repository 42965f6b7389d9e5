// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// When dividing cells no longer helps, because shapes are not known better.
#pragma once

#include "cells/open_cell.h"
#include "scene/band_margin.h"

namespace fcl_prob::detail {

/// Whether dividing an open cell would hardly settle more of it: it is small beside the band, or
/// what is open of it is a layer hardly thicker than that. Steers; no bound depends on it.
bool isAllBand(const OpenCell& open, const BandMargin& band);

}  // namespace fcl_prob::detail
