// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bounds/pair_bounds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "bounds/relaxed_integral.h"
#include "bounds/section.h"
#include "convex/cut_polytope.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

/// What a mass below the range of normal doubles is rounded up by.
constexpr double kTiny = 1e-300;

double roundedUp(double mass, int factors) {
  const double up = mass * (1.0 + 2.0 * factors * kIntervalMassRelativeError) + kTiny;
  return up >= 0.0 ? up : std::numeric_limits<double>::infinity();  // NaN: no bound
}

/// Support values of a body, rounding added: those of a C-obstacle, or of the vertices of a
/// section.
class Extents {
 public:
  Extents(const CObstacle* obstacle, const FaceSet& faces, double error)
      : obstacle_(obstacle), faces_(faces), error_(error) {}

  double upper(const Eigen::Vector3d& direction) const {
    if (obstacle_) return obstacle_->support(direction);
    double largest = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& v : faces_.vertices())
      largest = std::max(largest, direction.dot(v));
    return largest + error_;
  }
  double lower(const Eigen::Vector3d& direction) const { return -upper(-direction); }

 private:
  const CObstacle* obstacle_;
  const FaceSet& faces_;
  double error_;
};

double halfSpaceBound(const Extents& extents, const Eigen::Vector3d& direction) {
  return roundedUp(normalTailMass(extents.lower(direction)), 1);
}

/// Mass of the box around the body whose sides are along `axis`, `across` (unit, orthogonal) and
/// their cross product.
double boxBound(const Extents& extents, const Eigen::Vector3d& axis,
                const Eigen::Vector3d& across) {
  double mass = 1.0;
  for (const Eigen::Vector3d& side : {axis, across, Eigen::Vector3d(axis.cross(across))}) {
    mass *= normalIntervalMass(extents.lower(side), extents.upper(side));
  }
  return roundedUp(mass, 3);
}

/// Mass of the ball around the mean: two terms of its density's series, from below.
double centralBallMass(double radius) {
  const double r = std::min(radius, 1.0);
  return std::sqrt(2.0 / M_PI) * r * r * r * (1.0 / 3.0 - r * r / 10.0);
}

/// The polytope around a curved body sticks out of it, which matters towards the mean: it is cut to
/// the body's own extent along `n` and across.
void cutToSupports(const Extents& extents, const Eigen::Vector3d& n, FaceSet& faces) {
  CutPolytope polytope(faces);
  const Eigen::Vector3d u = n.unitOrthogonal();
  for (const Eigen::Vector3d& side : {n, u, Eigen::Vector3d(n.cross(u))}) {
    polytope.cut(side, extents.upper(side));
    polytope.cut(-side, -extents.lower(side));
  }
  polytope.writeTo(faces);
}

ConvexPcdBounds withLeast(ConvexPcdBounds bounds) {
  bounds.least = std::min({1.0, bounds.half_space, bounds.whitened_box, bounds.divergence});
  return bounds;
}

/// The proposal (unit or zero) whose half-space is farthest from the mean.
Eigen::Vector3d farthest(const Extents& extents, std::initializer_list<Eigen::Vector3d> proposals) {
  Eigen::Vector3d best = Eigen::Vector3d::UnitX();
  double distance = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& proposal : proposals) {
    if (!(proposal.squaredNorm() > 0.5) || !(extents.lower(proposal) > distance)) continue;
    distance = extents.lower(proposal);
    best = proposal;
  }
  return best;
}

ConvexPcdBounds scaled(ConvexPcdBounds bounds, double factor) {
  bounds.half_space *= factor;
  bounds.whitened_box *= factor;
  bounds.divergence *= factor;
  bounds.direction.setZero();
  return withLeast(bounds);
}

}  // namespace

Eigen::Matrix3d PairBounds::prepareFaces(const CObstacle& obstacle) {
  const PairFrame& frame = obstacle.frame();
  const double error_in_metres = obstacle.outerFaces(scratch_).error;
  if (frame.rank == 3) return error_in_metres * frame.whitening;
  const Eigen::Vector3d error = frame.whitened(std::max(error_in_metres, frame.error));
  replaceBySection(frame.rank, error, SectionSide::outer, scratch_.faces);
  return errorOfMoving(frame.rank, error) * Eigen::Matrix3d::Identity();
}

ConvexPcdBounds PairBounds::bounds(const CObstacle& obstacle, double enough) {
  const int rank = obstacle.frame().rank;
  if (!obstacle.frame().fits) return {};
  const auto ball = obstacle.ellipsoid();
  if (ball && rank == 3) return ellipsoidBounds(obstacle, *ball);

  const Eigen::Matrix3d error = prepareFaces(obstacle);
  const FaceSet& faces = scratch_.faces;
  if (rank < 3 && faces.vertices().empty()) return scaled({}, 0.0);
  if (rank == 0) return {};

  const Extents extents(rank == 3 ? &obstacle : nullptr, faces, error.norm());
  const Separation separation = separationOf(faces, rank);
  if (rank == 3 && centralBallMass(separation.depth) >= enough) return {};
  const bool curved = rank == 3 && !obstacle.isPolytope();
  const Eigen::Vector3d gjk = curved ? gjkDirection(obstacle) : Eigen::Vector3d::Zero();
  const Eigen::Vector3d n = farthest(extents, {separation.nearest, separation.face, gjk});

  if (curved) cutToSupports(extents, n, scratch_.faces);

  ConvexPcdBounds result;
  result.direction = n;
  result.half_space = halfSpaceBound(extents, n);
  result.whitened_box = boxBound(extents, n, longestEdgeAcross(faces, n));
  if (separation.face.squaredNorm() > 0.5 && separation.face != n) {
    result.whitened_box =
        std::min(result.whitened_box,
                 boxBound(extents, separation.face, longestEdgeAcross(faces, separation.face)));
  }
  result.divergence = roundedUp(relaxedIntegral(faces, error, n, work_).upper(), 0);
  return rank == 3 ? withLeast(result) : scaled(result, 1.0 / prismMass(rank));
}

ConvexPcdBounds PairBounds::ellipsoidBounds(const CObstacle& obstacle, const Ellipsoid& ball) {
  scratch_.faces.clear();
  const Extents extents(&obstacle, scratch_.faces, 0.0);
  const PairFrame& frame = obstacle.frame();
  const Eigen::Vector3d nearest = ball.nearestPoint(frame).stableNormalized();
  const Eigen::Vector3d to_centre = (frame.whitening * ball.centre).stableNormalized();

  ConvexPcdBounds result;
  result.direction = farthest(extents, {nearest, to_centre});
  result.half_space = halfSpaceBound(extents, result.direction);
  result.whitened_box =
      std::min(boxBound(extents, result.direction, result.direction.unitOrthogonal()),
               boxBound(extents, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()));
  result.divergence = roundedUp(relaxedIntegral(ball, frame, result.direction).upper(), 0);
  return withLeast(result);
}

}  // namespace fcl_prob::detail
