// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The smallest scene that still fails.
#pragma once

#include <functional>
#include <string>

#include "scene.h"

namespace fcl_prob_audit {

/// Simplifies the scene (fewer members, triangles, cells and components, shorter numbers, default
/// requests) for as long as `fails` holds, which is asked `most` times at most.
Scene shrunk(Scene scene, const std::function<bool(const Scene&)>& fails, int most = 600);

}  // namespace fcl_prob_audit
