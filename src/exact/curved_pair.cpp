// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/curved_pair.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/left_out.h"
#include "convex/nearest.h"
#include "convex/perturbation.h"
#include "exact/axes_surface.h"
#include "exact/curved_parts.h"
#include "exact/rim_surface.h"
#include "fcl_prob/normal_mass.h"
#include "geometry/exact_sum.h"
#include "mass/long_whitening.h"
#include "mass/part_rules.h"
#include "mass/surface_cubature.h"

namespace fcl_prob::detail {
namespace {

/// Of the mass of the box around a body.
constexpr double kGuess = 0.05;

/// Of a ball that is seen from a point near the mean, next to itself.
constexpr double kLeastSize = 0x1p-60;

/// A point of the surface is a sum of points of the parts, whatever their normals are, rounded a
/// few times; V' is another error from V.
constexpr double kPointErrors = 8.0;

/// Of logarithms of masses.
constexpr double kLogRounding = 1e-6;

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

/// Orthonormal rows, the last one along a direction.
Eigen::Matrix3d axesAlong(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d z = direction.normalized(), x = z.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << x.transpose(), z.cross(x).transpose(), z.transpose();
  return axes;
}

/// Towards the nearest point or, if the mean is inside or GJK fails, the middle.
Eigen::Vector3d directionTo(const CObstacle& obstacle, const Eigen::Vector3d& centre) {
  Eigen::Vector3d nearest = gjkDirection(obstacle);
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

/// Of where the bodies are, known to 2⁻⁶² of a long double.
double farRounding(const CurvedSum& sum) {
  return 0x1p-58 * static_cast<double>(sum.offset.norm());
}

/// What is within V: a ball, as it is in the world, and a point near the mean.
struct WithinBody {
  Eigen::Vector3d centre;  ///< of the ball, whitened
  double radius;           ///< metres
  std::optional<Eigen::Vector3d> point;

  /// The ball's centre and radius on its way to the point, seen from which it is of this size.
  Eigen::Vector3d centreAt(double size) const {
    return point ? Eigen::Vector3d(*point + size * (centre - *point)) : centre;
  }
};

/// No more than the log of the mass of a ball in the world: by Jensen's inequality, exp being
/// convex.
double logMassOfBall(const Eigen::Vector3d& centre, double radius,
                     const Eigen::Vector3d& deviations) {
  const Eigen::Array3d scaled = radius / deviations.array();
  const double mean_square = centre.squaredNorm() + scaled.square().sum() / 5.0;
  return std::log(4.0 / 3.0 * M_PI * kDensityScale) + scaled.log().sum() - 0.5 * mean_square;
}

/// A bound on |log P(V) - log P(V')| for V' with V less δ within it and itself within V plus δ.
/// With E a ball of one metre let V(t) be V ⊕ tE or, for t < 0, what is |t| deep in V: the log of
/// its mass is concave in t (Prékopa), so that it grows beyond -δ by no more than on its way there
/// from any V(-τ), of which a ball's mass is enough. That is the ball within V, shrunk on its way
/// to a point near the mean: where from is free. \param log_mass  of V', at the most
std::optional<double> shareBetween(double error, double log_mass, const WithinBody& within,
                                   const Eigen::Vector3d& deviations) {
  double least = kInfinity;
  for (double size = 1.0; size > kLeastSize; size *= 0.5) {
    const double depth = 0.5 * (size * within.radius - kPointErrors * error);
    if (!(depth > 2.0 * error)) break;
    const double fall =
        log_mass - logMassOfBall(within.centreAt(size), depth, deviations) + kLogRounding;
    least = std::min(least, error * std::max(fall, 0.0) / (depth - error));
    if (!within.point) break;
  }
  return least < 0.1 ? std::optional<double>(1.01 * least) : std::nullopt;
}

/// What is in one of the two bodies only weighs at most share and share / (1 - share) of V.
PairMass widened(const SurfaceMass& found, double share, const LongMatrix3& map) {
  PairMass result{{found.mass.lower * (1.0 - share), found.mass.upper * (1.0 + 1.1 * share)}, {}};
  if (!found.moment) return result;
  VectorBounds moment = *found.moment;
  const double between = kOutermostMoment * 2.2 * share * std::max(result.mass.upper, 0.0);
  moment.lower.array() -= between;
  moment.upper.array() += between;
  result.gradient = gradientOf(moment, map.cast<double>());
  return result;
}

/// The difference of the points that the bodies are seen from, less the mean.
LongVector3 offsetOf(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                     const fcl::Transform3d& pose_b, const Eigen::Vector3d& mean) {
  const auto middleOf = [](const ConvexBody& body) -> Eigen::Vector3d {
    const auto curved = curvedBody(body, Eigen::Matrix3d::Identity());
    return curved ? curved->centre : Eigen::Vector3d::Zero();
  };
  ExactPosition offset;
  offset.add(pose_b, middleOf(b));
  offset.add(pose_a, middleOf(a), -1.0);
  offset.add(mean, -1.0);
  return offset.value();
}

/// The patches of parts that are placed, and how far what they enclose may be from the true sum, in
/// metres.
struct PlacedSurface {
  std::vector<SurfacePatch> patches;
  double error;
};

std::optional<PlacedSurface> placedSurface(const CurvedParts& parts) {
  const double far = farRounding(parts.sum) + parts.error;
  if (parts.second) {
    const AxesSum axes{parts.sum, *parts.second, parts.second_frame};
    auto patches = axesSurface(axes);
    if (!patches) return std::nullopt;
    return PlacedSurface{std::move(*patches), axes.rounding() + far};
  }
  const double rounding = parts.sum.rounding() + far;
  if (!parts.polytope) return PlacedSurface{surfaceOf(parts.sum), rounding};
  auto surface = rimSurface(parts.sum, *parts.polytope);
  if (!surface) return std::nullopt;
  double size = 0.0;
  for (const Eigen::Vector3d& v : parts.polytope->vertices) size = std::max(size, v.norm());
  return PlacedSurface{std::move(surface->patches),
                       rounding + surface->defect + 32.0 * kEpsilon * size};
}

}  // namespace

bool isCurvedPair(const ConvexBody& a, const ConvexBody& b) {
  return haveCurvedParts(a, b) && !isLeftOut("curved boundaries");
}

PairMass curvedPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                        const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                        const RoundedEffort& effort) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  if (!frame.fits || frame.rank < 3) return {};
  const LongVector3 offset = offsetOf(a, pose_a, b, pose_b, displacement.mean());
  const LongMatrix3 whitening = longWhitening(displacement);
  const ShapeObstacle obstacle(frame, shapeOf(a), shapeOf(b));
  const Eigen::Vector3d direction = directionTo(obstacle, (whitening * offset).cast<double>());
  // A reflection leaves N(0, I) as it is.
  const double handedness = whitening.determinant() < 0.0L ? -1.0 : 1.0;
  const Eigen::Vector3d reflection(handedness, 1.0, 1.0);
  const LongMatrix3 map = reflection.cast<long double>().asDiagonal() * whitening;
  SurfaceEffort of_surface;
  of_surface.with_moment = effort.moment;
  of_surface.axes = axesAlong(reflection.asDiagonal() * direction);
  for (int attempt = 0; attempt < kPerturbationAttempts; ++attempt) {
    auto parts = curvedParts(a, frame.rotation_a, b, frame.rotation_b, attempt);
    if (!parts) return {};
    parts->sum.map = map;
    parts->sum.offset = offset;
    const auto surface = placedSurface(*parts);
    if (!surface) continue;
    const SurfaceMass mass =
        massWithin(surface->patches, guessOf(obstacle, direction), effort.interruption, of_surface);
    const LongVector3 middle = offset + parts->sum.frame * parts->middle.cast<long double>();
    const WithinBody within{(map * middle).cast<double>(), parts->inradius, mass.nearest};
    const auto share = shareBetween(surface->error, std::log(mass.mass.upper), within,
                                    displacement.standardDeviations());
    return share ? widened(mass, *share, map) : PairMass{};
  }
  return {};
}

}  // namespace fcl_prob::detail
