// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where benchmarks with random scenes put one mesh beside another.
#pragma once

#include "bench/uniforms.h"
#include "cli/geometry.h"

namespace fcl_prob::cli {

/// Turned at random, on a random side of a random vertex of B, moved towards it from `farthest`
/// metres away until the two are `apart` metres apart; B is at the identity.
fcl::Transform3d poseBeside(Uniforms& random, const Geometry& a, const TriangleMesh& mesh_b,
                            const Geometry& b, double apart, double farthest, int halvings);

}  // namespace fcl_prob::cli
