// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of a polytope under N(0, I) as a sum over its edges, with a bound on every error.
#pragma once

#include <optional>

#include "base/interruption.h"
#include "mass/polytope_boundary.h"

namespace fcl_prob::detail {

/// A value and a bound on |value - truth|.
struct MassWithError {
  double value = 0.0;
  double error = 0.0;
};

/// The mass by the divergence theorem. The error covers quadrature, rounding, and that the faces
/// are computed as planar polygons that are off by FaceFrame::deviation at their edges; not the
/// mass of the thin slabs between those polygons and the true surface (see surfaceSlabMass()).
///
/// With the radial field of divergence φ, the flux through a face with height h above its foot is a
/// sum over its edges (inset e, position t, r² = h² + e² + t², dθ = e/(e² + t²) dt):
///   tail   [origin inside] - (1/4π) Σ sgn(h) (erfc(|h|/√2) ω - |h| Σ ∫ erfc(r/√2)/r dθ)
///   core   (1/4π) Σ sgn(h) Σ ∫ (erf(|h|/√2) - |h| erf(r/√2)/r) dθ
/// where ω is the angle of the face's contour around its foot. The first keeps its relative
/// accuracy far from the origin, the second has no singularity where the origin is on the boundary.
/// At its foot (e = t = 0) an integrand of the first is taken apart into erfc(|h|/√2)/|h|, whose
/// angles are added exactly, and a smooth remainder.
///
/// Returns nothing if the interruption is due.
std::optional<MassWithError> boundaryMass(const PolytopeBoundary& boundary,
                                          const Interruption& interruption = {});

/// Bounds on what a body gains and loses when its surface moves by up to a distance.
struct SlabMass {
  double gain = 0.0;
  double loss = 0.0;
};

/// Mass within `face.*distance + extra` of each face, outside and inside,
/// summed over the faces.
SlabMass surfaceSlabMass(const PolytopeBoundary& boundary, double FaceFrame::*distance,
                         double extra);

}  // namespace fcl_prob::detail
