// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#pragma once

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// Volume that a closed mesh encloses, cubic metres, from its triangles as they are oriented.
double enclosedVolume(const TriangleMesh& mesh);

}  // namespace fcl_prob::detail
