// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Certified masses of C-obstacles.
#include <algorithm>
#include <limits>

#include "fcl_prob/normal_mass.h"
#include "fcl_prob/polytope_mass.h"
#include "narrowphase/pair_bounds.h"
#include "narrowphase/section.h"

namespace fcl_prob::detail {
namespace {

/// Moves the faces inwards (by scaling about a point inside) by at least `error`, so that the true
/// body contains them. Leaves nothing of a body that is not thicker than that.
void shrink(double error, FaceSet& faces) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : faces.vertices()) centre += v;
  centre /= static_cast<double>(faces.vertices().size());
  double inradius = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    const Eigen::Vector3d area = faces.vectorArea(f);
    if (!(area.norm() > 0.0)) continue;
    inradius = std::min(inradius, area.normalized().dot(faces.position(f, 0) - centre));
  }
  const double scale = 1.0 - 2.0 * error / inradius;
  if (!(scale > 0.0) || faces.faceCount() == 0) {
    faces.clear();
    return;
  }
  for (Eigen::Vector3d& v : faces.vertices()) v = centre + scale * (v - centre);
}

Bounds massOfPrism(int rank, double error, const FaceSet& faces, const MassEffort& effort) {
  if (faces.vertices().empty()) return {0.0, 0.0};
  if (rank == 0) return {1.0, 1.0};
  Bounds mass = polytopeMass(toClosedPolytope(faces), error, effort);
  mass.lower /= prismMass(rank) * (1.0 + 8.0 * kIntervalMassRelativeError);
  mass.upper /= prismMass(rank) * (1.0 - 8.0 * kIntervalMassRelativeError);
  return mass;
}

}  // namespace

Bounds PairBounds::massOfSection(int rank, const Eigen::Vector3d& error, const MassEffort& effort) {
  const double moving_error = errorOfMoving(rank, error);
  FaceSet inner = scratch_.faces;
  shrink(error.norm(), inner);
  replaceBySection(rank, Eigen::Vector3d::Zero(), inner);
  replaceBySection(rank, error, scratch_.faces);
  return {massOfPrism(rank, moving_error, inner, effort).lower,
          massOfPrism(rank, moving_error, scratch_.faces, effort).upper};
}

Bounds PairBounds::mass(const CObstacle& obstacle, const MassEffort& effort) {
  const PairFrame& frame = obstacle.frame();
  if (!frame.fits) return {0.0, 1.0};
  setInterruption(effort.interruption);
  const EnclosingFaces enclosing = obstacle.outerFaces(scratch_);
  const Eigen::Vector3d error = frame.whitened(enclosing.error);
  Bounds mass = frame.rank < 3
                    ? massOfSection(frame.rank, error, effort)
                    : polytopeMass(toClosedPolytope(scratch_.faces), error.norm(), effort);
  mass.lower = enclosing.only_box ? 0.0 : std::max(mass.lower, 0.0);
  mass.upper = std::min(mass.upper, 1.0);
  return mass;
}

}  // namespace fcl_prob::detail
