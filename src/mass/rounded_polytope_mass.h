// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of a convex polytope swept by a ball, under any Gaussian of three dimensions.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "base/interruption.h"
#include "fcl_prob/polytope_mass.h"
#include "mass/rounded_parts.h"

namespace fcl_prob::detail {

/// core ⊕ ball(radius): the C-obstacle of spheres and capsules beside polytopes. Metres.
struct RoundedPolytope {
  ConvexPolytope core;  ///< two faces for a polygon, none for a segment or a point
  double radius = 0.0;  ///< positive
  double error = 0.0;   ///< how far the true body may reach out of this one, or into it
  LongVector3 origin = LongVector3::Zero();  ///< of the core, seen from the mean
};

/// What is asked of it beyond the mass.
struct RoundedEffort {
  bool moment = false;
  Interruption interruption;
};

struct RoundedMass {
  Bounds mass{0.0, 1.0};
  std::optional<VectorBounds> moment;  ///< ∫ y φ dy, whitened, if asked for
};

/// Certified mass under N(0, I) of the body mapped by `whitening`, a diagonal matrix times a
/// rotation. The core counts as a polytope, what is around it as prisms, wedges and sectors
/// (solid_part.h) by Gauss rules with a bound on their error: relative width 1e-10 or less where
/// the error of the body allows it, the mass is above 1e-280 and the body is up to about 1e3
/// deviations large. No iteration has to converge: where a fixed number of boxes is not enough, the
/// bounds are wide, at the worst [0, 1].
RoundedMass roundedPolytopeMass(const RoundedPolytope& body, const LongMatrix3& whitening,
                                const RoundedEffort& effort = {});

}  // namespace fcl_prob::detail
