// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is around a convex polytope within a distance: prisms, wedges and sectors.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fcl_prob/convex_polytope.h"
#include "gaussian/long_vector.h"
#include "mass/solid_part.h"

namespace fcl_prob::detail {

/// The parts around a polytope K. They are computed from normals that are rounded, but neighbours
/// share theirs, so that the parts of up to a radius r, added to K, make a region V' with
/// K ⊕ ball(r - defect) ⊆ V' ⊆ K ⊕ ball(r): a point of K moved by up to r along a normal n there is
/// within r of K, and with the largest of n·x over K no more than `defect` above it, at the full
/// r it is r - defect away at least. The outer surface, which the parts close, is between the two
/// and winds once around what it encloses; parts only add to that (those that are turned around
/// count as error, see PartCubature).
struct RoundedParts {
  std::vector<AnyPart> parts;
  std::vector<Eigen::Vector3d> normals;  ///< of the core's faces, those of slivers mended
  double defect = 0.0;                   ///< metres
  double stretch = 0.0;                  ///< no less than the norm of the whitening

  /// Up to which distance (metres, positive).
  void setRadius(double radius);
};

/// \param core  metres; faces closed and oriented outwards, two of them for a polygon, none for a
/// segment or a point
/// \param origin  of the core, seen from the mean: far away, nothing of a small core is lost
/// \return nothing if the faces do not close or their normals are no use
std::optional<RoundedParts> roundedParts(const ConvexPolytope& core, const LongVector3& origin,
                                         const LongMatrix3& whitening);

/// A vector of the world in the whitened frame, rounded once but for a long double.
inline Eigen::Vector3d whitened(const LongMatrix3& whitening, const Eigen::Vector3d& vector,
                                const LongVector3& origin = LongVector3::Zero()) {
  return (whitening * (vector.cast<long double>() + origin)).cast<double>();
}

}  // namespace fcl_prob::detail
