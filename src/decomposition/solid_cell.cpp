// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/solid_cell.h"

#include "decomposition/point_sets.h"

namespace fcl_prob::detail {
namespace {

/// Of the way to the middle of a cell: far enough from a corner for its surroundings to be known.
constexpr double kStepInside = 1e-6;

}  // namespace

SolidCell::SolidCell(const TriangleMesh& mesh, const ClosedMesh* solid) : solid_(solid) {
  if (!solid) return;
  cell_.start(boxAround(mesh));
  findCorners();
}

SolidCell SolidCell::below(const CutPlane& plane) const {
  SolidCell part;
  if (!solid_) return part;
  part.solid_ = solid_;
  part.cell_ = cell_;
  part.cell_.cut(plane.normal, plane.offset);
  part.findCorners();
  return part;
}

void SolidCell::findCorners() {
  FaceSet faces;
  cell_.writeTo(faces);
  for (const Eigen::Vector3d& corner : faces.vertices()) {
    if (reachesInto(corner, faces.vertices())) corners_inside_.push_back(corner);
  }
}

/// A corner on the surface counts if the cell has the solid next to it: where the surface only
/// touches the cell there, no piece of the surface is in the cell to tell.
bool SolidCell::reachesInto(const Eigen::Vector3d& corner,
                            const std::vector<Eigen::Vector3d>& corners) const {
  const Containment containment = solid_->contains(corner);
  if (containment != Containment::unknown) return containment == Containment::inside;
  const Eigen::Vector3d inwards = corner + kStepInside * (middleOf(corners) - corner);
  return solid_->contains(inwards) != Containment::outside;
}

}  // namespace fcl_prob::detail
