// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Certified masses of C-obstacles.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fcl_prob/normal_mass.h"
#include "fcl_prob/polytope_mass.h"
#include "narrowphase/pair_bounds.h"
#include "narrowphase/section.h"

namespace fcl_prob::detail {
namespace {

/// Of a sum of three products of differences, relative to the sum of their magnitudes.
constexpr double kDotRounding = 8.0 * std::numeric_limits<double>::epsilon();

/// A face whose corners leave its normal more uncertain than this (radians) says nothing.
constexpr double kMostTilt = 1e-3;

/// What one face says about how far the boundary is from a point inside.
struct FaceClearance {
  double distance;  ///< of its plane, from below, whatever rounding made of its normal
  double width;
};

FaceClearance clearanceOf(const FaceSet& faces, std::size_t f, const Eigen::Vector3d& centre) {
  const Eigen::Vector3d area = faces.vectorArea(f);
  const Eigen::Vector3d normal = area.stableNormalized();
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest, rounding = 0.0;
  for (int i = 0, last = faces.cornerCount(f) - 1; i <= last; ++i) {
    const Eigen::Vector3d side = faces.position(f, i) - faces.position(f, i ? i - 1 : last);
    if (side.stableNorm() > longest.stableNorm()) longest = side;
    const Eigen::Vector3d way = faces.position(f, i) - centre;
    nearest = std::min(nearest, normal.dot(way));
    farthest = std::max(farthest, normal.dot(way));
    rounding = std::max(rounding, kDotRounding * normal.cwiseAbs().dot(way.cwiseAbs()));
  }
  const double length = longest.stableNorm();
  const double width = length > 0.0 ? 2.0 * area.stableNorm() / length : 0.0;
  const double uneven = farthest - nearest + 2.0 * rounding;
  if (!(uneven < kMostTilt * width)) return {-std::numeric_limits<double>::infinity(), width};
  // A plane through the corners may be tilted by this much along the face and across it.
  const Eigen::Vector3d way = faces.position(f, 0) - centre;
  const double along = std::abs(longest.dot(way)) / length;
  const double across = std::abs(normal.cross(longest).dot(way)) / length;
  return {nearest - rounding - uneven * (1.0 + 2.0 * along / length + 2.0 * across / width), width};
}

/// Distance from `centre` to the boundary, from below. The normal of a narrow face is noise; where
/// such a face seems near, it is still no farther than its width from one that is not.
double clearance(const FaceSet& faces, const Eigen::Vector3d& centre) {
  std::vector<FaceClearance> each;
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    each.push_back(clearanceOf(faces, f, centre));
  }
  std::sort(each.begin(), each.end(),
            [](const FaceClearance& f, const FaceClearance& g) { return f.distance < g.distance; });
  double best = 0.0;
  double widths = 0.0;  // of the faces that are passed over
  for (const FaceClearance& face : each) {
    best = std::max(best, face.distance - 2.0 * widths);
    widths += face.width;
  }
  return best;
}

/// Moves the faces inwards (by scaling about a point inside) by at least `error`, so that the true
/// body contains them. Leaves nothing of a body that is not thicker than that.
void shrink(double error, FaceSet& faces) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : faces.vertices()) centre += v;
  centre /= static_cast<double>(faces.vertices().size());
  const double inradius = clearance(faces, centre);
  if (!(inradius > 2.0 * error)) {
    faces.clear();
    return;
  }
  const double scale = 1.0 - 2.0 * error / inradius;
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
