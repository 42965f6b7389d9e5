// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "narrowphase/curved_pair.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "cobstacle/nearest.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/constants.h"
#include "gaussian/surface_cubature.h"
#include "geometry/exact_sum.h"
#include "narrowphase/curved_surface.h"
#include "narrowphase/long_whitening.h"

namespace fcl_prob::detail {
namespace {

/// Of the mass of the box around a body.
constexpr double kGuess = 0.05;

/// By support functions, for GJK to propose directions.
class ShapeObstacle final : public CObstacle {
 public:
  ShapeObstacle(const PairFrame& frame, SupportShape a, SupportShape b)
      : CObstacle(frame), a_(std::move(a)), b_(std::move(b)) {}

  bool isPolytope() const override { return false; }

 protected:
  Eigen::Vector3d worldSupportPoint(const Eigen::Vector3d& direction) const override {
    const Eigen::Matrix3d &rotation_a = frame().rotation_a, &rotation_b = frame().rotation_b;
    return rotation_b * b_.supportPoint(rotation_b.transpose() * direction) -
           rotation_a * a_.supportPoint(-(rotation_a.transpose() * direction)) + frame().offset;
  }
  std::optional<double> worldFaces(ObstacleScratch&) const override { return std::nullopt; }

 private:
  SupportShape a_, b_;
};

/// A rotation that takes a unit vector to e_z.
LongMatrix3 rotationToAxis(const Eigen::Vector3d& direction) {
  const LongVector3 z = direction.cast<long double>().normalized();
  const LongVector3 x = z.unitOrthogonal().normalized();
  LongMatrix3 rotation;
  rotation.row(0) = x.transpose();
  rotation.row(1) = z.cross(x).transpose();
  rotation.row(2) = z.transpose();
  return rotation;
}

/// Towards the nearest point or, if the mean is inside or GJK fails, the middle.
Eigen::Vector3d directionTo(const CObstacle& obstacle, const Eigen::Vector3d& centre) {
  const Eigen::Vector3d nearest = gjkDirection(obstacle);
  if (nearest.squaredNorm() > 0.0 && nearest.allFinite()) return nearest;
  const double distance = centre.stableNorm();
  return distance > 0.0 ? Eigen::Vector3d(centre / distance) : Eigen::Vector3d::UnitZ();
}

/// About the mass, rather too small than too large: then one attempt is enough.
double guessOf(const CObstacle& obstacle, const Eigen::Vector3d& direction) {
  const auto widthAlong = [&](const Eigen::Vector3d& d) {
    return obstacle.support(d) + obstacle.support(-d);
  };
  const Eigen::Vector3d across = direction.unitOrthogonal();
  const double distance = std::max(0.0, -obstacle.support(-direction));
  return kGuess * normalTailMass(distance) *
         std::min(1.0, std::max(distance, 0.5) * widthAlong(direction)) *
         std::min(1.0, 0.4 * widthAlong(across)) *
         std::min(1.0, 0.4 * widthAlong(direction.cross(across)));
}

/// B ⊕ (−A), not yet mapped, and a ball within it.
struct SumWithBall {
  CurvedSum sum;
  double inradius = 0.0;  ///< around its centre, metres
};

/// At most one of both has a frustum. −A is A turned upside down, since both are symmetric about
/// the axis and ellipsoids about their centres.
SumWithBall sumOf(const CurvedBody& a, const CurvedBody& b) {
  SumWithBall result;
  for (const CurvedBody* body : {&a, &b}) {
    if (!body->ellipsoid) continue;
    result.sum.ellipsoids.push_back(*body->ellipsoid);
    result.inradius += body->least_axis;
  }
  if (b.frustum) {
    result.sum.frustum = *b.frustum;
    result.sum.frame = b.frame;
  } else if (a.frustum) {
    result.sum.frustum = {a.frustum->half_height, a.frustum->top, a.frustum->bottom};
    result.sum.frame = a.frame;
  } else {
    // In the frame of a ellipsoid its own normals are even.
    result.sum.frame = result.sum.ellipsoids.front();
  }
  result.inradius += result.sum.frustum.inradius();
  return result;
}

/// Of where the bodies are, known to 2⁻⁶² of a long double.
double farRounding(const CurvedSum& sum) {
  return 0x1p-58 * static_cast<double>(sum.centre.norm());
}

LongVector3 centreBetween(const CurvedBody& a, const fcl::Transform3d& pose_a, const CurvedBody& b,
                          const fcl::Transform3d& pose_b, const Eigen::Vector3d& mean) {
  ExactPosition centre;
  centre.add(pose_b, b.centre);
  centre.add(pose_a, a.centre, -1.0);
  centre.add(mean, -1.0);
  return centre.value();
}

/// With V' within δ of a convex V, and V' holding a ball of radius ϱ about c: c + λ(V' - c) is in V
/// for λ = 1 - δ/ϱ, and V in the same for 1/λ. Masses of these are at least λ³ exp(-(1 - λ)|c|²/2)
/// of each other, |·|² being convex.
Bounds widened(const Bounds& mass, double error, double inradius, double centre) {
  if (!(error < 1e-3 * inradius)) return {0.0, 1.0};
  const double share = 1.01 * error / inradius * (3.0 + 0.5 * centre * centre);
  if (!(share < 0.1)) return {0.0, 1.0};
  return {mass.lower * (1.0 - share), mass.upper * (1.0 + 1.1 * share)};
}

}  // namespace

bool isCurvedPair(const ConvexBody& a, const ConvexBody& b) {
  const auto body_a = curvedBody(a, Eigen::Matrix3d::Identity());
  const auto body_b = curvedBody(b, Eigen::Matrix3d::Identity());
  return body_a && body_b && !(body_a->frustum && body_b->frustum);
}

Bounds curvedPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                      const Interruption& interruption) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  const auto body_a = curvedBody(a, frame.rotation_a), body_b = curvedBody(b, frame.rotation_b);
  if (!frame.fits || frame.rank < 3 || !body_a || !body_b) return {0.0, 1.0};
  const SumWithBall body = sumOf(*body_a, *body_b);
  const LongVector3 centre = centreBetween(*body_a, pose_a, *body_b, pose_b, displacement.mean());
  const LongMatrix3 whitening = longWhitening(displacement);
  const ShapeObstacle obstacle(frame, shapeOf(a), shapeOf(b));
  const Eigen::Vector3d direction = directionTo(obstacle, (whitening * centre).cast<double>());
  CurvedSum sum = body.sum;
  sum.map = rotationToAxis(direction) * whitening;
  // A reflection leaves N(0, I) as it is.
  if (sum.map.determinant() < 0.0L) sum.map.row(0) *= -1.0L;
  sum.centre = sum.map * centre;
  const double guess = guessOf(obstacle, direction);
  const Bounds mass = massWithin(surfaceOf(sum), guess, interruption);
  const double inradius =
      body.inradius / displacement.standardDeviations().maxCoeff() * (1.0 - 8.0 * kEpsilon);
  return widened(mass, sum.rounding() + farRounding(sum), inradius,
                 static_cast<double>(sum.centre.norm()) * (1.0 + kEpsilon));
}

}  // namespace fcl_prob::detail
