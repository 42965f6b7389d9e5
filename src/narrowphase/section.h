// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Displacements of rank below 3: the section of a C-obstacle that they can reach.
#pragma once

#include "cobstacle/face_set.h"

namespace fcl_prob::detail {

/// Replaces a body by a prism around its section with the subspace in which only the first `rank`
/// coordinates are not zero. Along the others the prism extends over [-kPrismHalfWidth,
/// kPrismHalfWidth], as if they were normal too: the mass of the section is that of the prism
/// divided by prismMass(rank). An empty section leaves no faces. \param error  (whitened, but for
/// the coordinates that do not move in metres) the body may reach out
///               of its faces by this in every coordinate; the prism is widened by it
void replaceBySection(int rank, const Eigen::Vector3d& error, FaceSet& faces);

inline constexpr double kPrismHalfWidth = 0x1p-6;

double prismMass(int rank);

/// Length of the first `rank` coordinates (at least one) of an error.
double errorOfMoving(int rank, const Eigen::Vector3d& error);

}  // namespace fcl_prob::detail
