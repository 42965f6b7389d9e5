// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The mass of a convex obstacle's section, wherever within a tiny distance the section is.
#pragma once

#include <functional>

#include "convex/resolved_part.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// Certified mass that a displacement has in a convex obstacle.
using MassOf = std::function<Bounds(const GaussianDisplacement&)>;

/// Bounds on the mass in a convex obstacle of a displacement that also moves, along axes that were
/// left out of it, by what rounds positions. The mass of what is left is log-concave in its mean
/// (Prékopa), so that the masses at the mean and at six places `step` metres around it bound how it
/// changes within so little. Where nothing is left: 1 if more than half of a displacement of `step`
/// along all axes is in the obstacle, whose sides are then no nearer than that.
/// {0, 1} where that tells nothing: beside the obstacle, or so near to its sides.
Bounds massNear(const MassOf& mass_of, const ResolvedPart& resolved, double step);

}  // namespace fcl_prob::detail
