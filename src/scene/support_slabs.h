// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Slabs around a C-obstacle that is known by its support function.
#pragma once

#include "convex/support_obstacle.h"
#include "scene/piece_slabs.h"

namespace fcl_prob::detail {

/// A few slabs that contain V, as many as possible along flat sides of it. Their margins have no
/// end: they say nothing of what is inside V.
PieceSlabs supportSlabs(const SupportObstacle& obstacle);

}  // namespace fcl_prob::detail
