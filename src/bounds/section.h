// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Displacements of rank below 3: the section of a C-obstacle that they can reach.
#pragma once

#include "convex/face_set.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// Which side the section must not be on the wrong one of.
enum class SectionSide {
  inner,  ///< the faces are within the body: the section is, too
  outer   ///< the body may reach out of the faces by the error: the section contains the body's
};

/// Replaces a body by a prism around its section with the subspace in which only the first `rank`
/// coordinates are not zero. Along the others the prism extends over [-kPrismHalfWidth,
/// kPrismHalfWidth], as if they were normal too: the mass of the section is that of the prism
/// divided by prismMass(rank). An empty section leaves no faces, and neither does an inner one of
/// less than `rank` dimensions.
///
/// Coordinates have different units (deviations, and lengths where nothing moves), so that none is
/// ever compared with another: each is measured in its own error, and there is no tolerance by
/// which a thin section would count as flat.
///
/// \param error  of the faces in every coordinate, rounding of the body's size and position
/// included
void replaceBySection(int rank, const Eigen::Vector3d& error, SectionSide side, FaceSet& faces);

/// The unit (a power of two) in which an error in every coordinate is at least 1 and less than 2
/// (less than 1 where it is next to nothing).
Eigen::Vector3d errorUnits(const Eigen::Vector3d& error);

/// Multiplies the coordinates; exact if the factors are powers of two.
void scaleCoordinates(const Eigen::Vector3d& factors, FaceSet& faces);

inline constexpr double kPrismHalfWidth = 0x1p-6;

double prismMass(int rank);

/// Length of the first `rank` coordinates (at least one) of an error.
double errorOfMoving(int rank, const Eigen::Vector3d& error);

}  // namespace fcl_prob::detail
