// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Certified masses of C-obstacles.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bounds/pair_bounds.h"
#include "bounds/section.h"
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/polytope_mass.h"

namespace fcl_prob::detail {
namespace {

/// Of a sum of three products of differences, relative to the sum of their magnitudes.
constexpr double kDotRounding = 8.0 * std::numeric_limits<double>::epsilon();

/// A face whose corners leave its normal more uncertain than this (radians) says nothing.
constexpr double kMostTilt = 1e-3;

/// Below the smallest normal double, absolutely.
constexpr double kUnderflow = 1e-300;

/// Distance from a point inside to the plane of a face, from below, whatever rounding made of the
/// face's normal.
double clearanceOf(const FaceSet& faces, std::size_t f, const Eigen::Vector3d& centre) {
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
  if (!(uneven < kMostTilt * width)) return -std::numeric_limits<double>::infinity();
  // A plane through the corners may be tilted by this much along the face and across it.
  const Eigen::Vector3d way = faces.position(f, 0) - centre;
  const double along = std::abs(longest.dot(way)) / length;
  const double across = std::abs(normal.cross(longest).dot(way)) / length;
  return nearest - rounding - uneven * (1.0 + 2.0 * along / length + 2.0 * across / width);
}

struct Ball {
  Eigen::Vector3d centre;
  double radius;
};

/// A ball within a body; of no radius if the normals of its faces are noise.
Ball ballAround(const Eigen::Vector3d& centre, const FaceSet& faces) {
  double radius = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    radius = std::min(radius, clearanceOf(faces, f, centre));
  }
  return {centre, faces.faceCount() > 0 ? std::max(radius, 0.0) : 0.0};
}

/// The point that `measure` is largest of.
template <typename Measure>
Eigen::Vector3d farthest(const FaceSet& faces, const Measure& measure) {
  const auto& points = faces.vertices();
  return *std::max_element(
      points.begin(), points.end(),
      [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return measure(p) < measure(q); });
}

/// The ball within a tetrahedron whose corners are some of a body's, about as thick as the body.
Ball ballInTetrahedron(const FaceSet& faces, const Eigen::Vector3d& start) {
  std::array<Eigen::Vector3d, 4> corner;
  const auto from = [](const Eigen::Vector3d& o) {
    return [o](const Eigen::Vector3d& p) { return (p - o).stableNorm(); };
  };
  corner[0] = farthest(faces, from(start));
  corner[1] = farthest(faces, from(corner[0]));
  const Eigen::Vector3d along = (corner[1] - corner[0]).stableNormalized();
  corner[2] = farthest(
      faces, [&](const Eigen::Vector3d& p) { return along.cross(p - corner[0]).stableNorm(); });
  const Eigen::Vector3d normal = along.cross(corner[2] - corner[0]).stableNormalized();
  corner[3] = farthest(
      faces, [&](const Eigen::Vector3d& p) { return std::abs(normal.dot(p - corner[0])); });
  if (normal.dot(corner[3] - corner[0]) > 0.0) std::swap(corner[1], corner[2]);
  FaceSet tetrahedron;
  for (const Eigen::Vector3d& p : corner) tetrahedron.addVertex(p);
  // Each is across from the corner of its number.
  tetrahedron.addFace({1, 3, 2});
  tetrahedron.addFace({0, 2, 3});
  tetrahedron.addFace({0, 3, 1});
  tetrahedron.addFace({0, 1, 2});
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  double sum = 0.0;
  for (std::size_t f = 0; f < 4; ++f) {
    const double area = tetrahedron.vectorArea(f).stableNorm();
    weighted += area * corner[f];
    sum += area;
  }
  if (!(sum > 0.0)) return {start, 0.0};
  return ballAround(weighted / sum, tetrahedron);
}

/// Normals of narrow faces may be noise, and such a face cannot be passed over: nothing says how
/// far the boundary is behind it. The corners are points of the body all the same.
Ball ballWithin(const FaceSet& faces) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : faces.vertices()) middle += v;
  middle /= static_cast<double>(faces.vertices().size());
  const Ball by_faces = ballAround(middle, faces);
  const Ball by_corners = ballInTetrahedron(faces, middle);
  return by_faces.radius >= by_corners.radius ? by_faces : by_corners;
}

/// Moves the faces inwards (by scaling about a point inside) by at least `error`, so that the true
/// body contains them. Leaves nothing of a body that is not thicker than that.
void shrink(double error, FaceSet& faces) {
  const Ball ball = ballWithin(faces);
  if (!(ball.radius > 2.0 * error)) {
    faces.clear();
    return;
  }
  const double scale = 1.0 - 2.0 * error / ball.radius;
  for (Eigen::Vector3d& v : faces.vertices()) v = ball.centre + scale * (v - ball.centre);
}

/// What the faces of a section, which contain it or are within it, weigh.
Bounds massOfPrism(int rank, const FaceSet& faces, const MassEffort& effort) {
  if (faces.vertices().empty()) return {0.0, 0.0};
  if (rank == 0) return {1.0, 1.0};
  if (rank == 1) {
    const auto [first, last] = std::minmax_element(
        faces.vertices().begin(), faces.vertices().end(),
        [](const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return p.x() < q.x(); });
    const double mass = normalIntervalMass(first->x(), last->x());
    const double rounding = 2.0 * kIntervalMassRelativeError * mass + kUnderflow;
    return {mass - rounding, mass + rounding};
  }
  Bounds mass = polytopeMass(toClosedPolytope(faces), 0.0, effort);
  mass.lower /= prismMass(rank) * (1.0 + 8.0 * kIntervalMassRelativeError);
  mass.upper =
      mass.upper / (prismMass(rank) * (1.0 - 8.0 * kIntervalMassRelativeError)) + kUnderflow;
  return mass;
}

}  // namespace

Bounds PairBounds::massOfSection(int rank, const Eigen::Vector3d& error, const MassEffort& effort) {
  const Eigen::Vector3d units = errorUnits(error);
  FaceSet inner = scratch_.faces;
  scaleCoordinates(units.cwiseInverse(), inner);
  shrink(error.cwiseQuotient(units).norm(), inner);
  scaleCoordinates(units, inner);
  replaceBySection(rank, error, SectionSide::inner, inner);
  replaceBySection(rank, error, SectionSide::outer, scratch_.faces);
  return {massOfPrism(rank, inner, effort).lower, massOfPrism(rank, scratch_.faces, effort).upper};
}

Bounds PairBounds::mass(const CObstacle& obstacle, const MassEffort& effort) {
  const PairFrame& frame = obstacle.frame();
  if (!frame.fits) return {0.0, 1.0};
  setInterruption(effort.interruption);
  const EnclosingFaces enclosing = obstacle.outerFaces(scratch_);
  Bounds mass = frame.rank < 3
                    ? massOfSection(frame.rank,
                                    frame.whitened(std::max(enclosing.error, frame.error)), effort)
                    : polytopeMass(toClosedPolytope(scratch_.faces),
                                   frame.whitened(enclosing.error).norm(), effort);
  mass.lower = enclosing.only_box ? 0.0 : std::max(mass.lower, 0.0);
  mass.upper = std::min(mass.upper, 1.0);
  return mass;
}

std::optional<VectorBounds> PairBounds::moment(const CObstacle& obstacle,
                                               const Interruption& interruption) {
  const PairFrame& frame = obstacle.frame();
  if (!frame.fits || frame.rank < 3 || !obstacle.isPolytope()) return std::nullopt;
  setInterruption(interruption);
  const EnclosingFaces enclosing = obstacle.outerFaces(scratch_);
  if (enclosing.only_box) return std::nullopt;
  return polytopeMoment(toClosedPolytope(scratch_.faces), frame.whitened(enclosing.error).norm());
}

}  // namespace fcl_prob::detail
