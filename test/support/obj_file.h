// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Reading the benchmark models without any library.
#pragma once

#include <string>

#include "mesh_shapes.h"

namespace fcl_prob_test {

/// Reads the `v` and triangular `f` lines of an OBJ file; throws std::runtime_error on anything
/// that the benchmark models do not contain.
TriangleMesh readObj(const std::string& path);

/// Volume enclosed by a closed mesh (divergence theorem).
double meshVolume(const TriangleMesh& mesh);

}  // namespace fcl_prob_test
