// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of the faces of a polytope under the standard normal density.
#pragma once

#include <vector>

#include "mass/boundary_mass.h"

namespace fcl_prob::detail {

/// ∫ φ dS over each face. In the plane of the face, with the foot of the origin as centre and
/// ρ² = e² + t² along an edge, the mass of a polygon under N(0, I) in two dimensions is
///   tail   ω/2π - (1/2π) Σ ∫ exp(-ρ²/2) dθ
///   core   (1/2π) Σ ∫ (1 - exp(-ρ²/2)) dθ
/// The error covers quadrature and rounding, for the plane polygon that the frame describes.
std::vector<MassWithError> faceMasses(const PolytopeBoundary& boundary);

}  // namespace fcl_prob::detail
