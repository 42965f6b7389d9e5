// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "narrowphase/curved_pair.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "cobstacle/nearest.h"
#include "cobstacle/perturbation.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/surface_cubature.h"
#include "geometry/exact_sum.h"
#include "narrowphase/axes_surface.h"
#include "narrowphase/curved_parts.h"
#include "narrowphase/long_whitening.h"
#include "narrowphase/rim_surface.h"

namespace fcl_prob::detail {
namespace {

/// Of the mass of the box around a body.
constexpr double kGuess = 0.05;

/// Beyond a reach of sqrt(kBeyondReach - 2 log P) there is less than this share of P.
constexpr double kBeyondReach = 80.0;
constexpr double kShareBeyond = 1e-15;

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
  return 0x1p-58 * static_cast<double>(sum.centre.norm());
}

/// With V' within δ of a convex V, and V' holding a ball of radius ϱ about c: c + λ(V' - c) is in V
/// for λ = 1 - δ/ϱ, and V in the same for 1/λ. Masses of these are at least λ³ exp(-(1 - λ)|c|²/2)
/// of each other, |·|² being convex; and, but for what is beyond R, which weighs no more than
/// (1 + R) exp(-R²/2), λ³ exp(-(1 - λ) R|c| - (1 - λ)² (R + |c|)²/2). Nothing if that is no use.
/// \param least  the mass may weigh
std::optional<double> shareBetween(double error, double inradius, double centre, double least) {
  if (!(error < 1e-3 * inradius)) return std::nullopt;
  const double gap = error / inradius;
  double slope = 0.5 * centre * centre;
  if (least > 0.0) {
    const double reach = std::sqrt(kBeyondReach - 2.0 * std::log(least));
    slope = std::min(slope, reach * centre + 0.5 * gap * (reach + centre) * (reach + centre));
  }
  const double share = 1.01 * gap * (3.0 + slope) + kShareBeyond;
  return share < 0.1 ? std::optional<double>(share) : std::nullopt;
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

/// The patches of parts that are placed, and how far what they enclose may be from the true sum.
struct PlacedSurface {
  std::vector<SurfacePatch> patches;
  double error;
};

std::optional<PlacedSurface> placedSurface(const CurvedParts& parts) {
  const double stretch = static_cast<double>(parts.sum.map.norm()) * (1.0 + 1e-8);
  const double far = farRounding(parts.sum) + parts.error * stretch;
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
                       rounding + (surface->defect + 32.0 * kEpsilon * size) * stretch};
}

}  // namespace

bool isCurvedPair(const ConvexBody& a, const ConvexBody& b) { return haveCurvedParts(a, b); }

Bounds curvedPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                      const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                      const Interruption& interruption) {
  return curvedPairMassAndGradient(a, pose_a, b, pose_b, displacement, false, interruption).mass;
}

PairMass curvedPairMassAndGradient(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                   const ConvexBody& b, const fcl::Transform3d& pose_b,
                                   const GaussianDisplacement& displacement, bool with_gradient,
                                   const Interruption& interruption) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  if (!frame.fits || frame.rank < 3) return {};
  const LongVector3 offset = offsetOf(a, pose_a, b, pose_b, displacement.mean());
  const LongMatrix3 whitening = longWhitening(displacement);
  const ShapeObstacle obstacle(frame, shapeOf(a), shapeOf(b));
  const Eigen::Vector3d direction = directionTo(obstacle, (whitening * offset).cast<double>());
  LongMatrix3 map = rotationToAxis(direction) * whitening;
  // A reflection leaves N(0, I) as it is.
  if (map.determinant() < 0.0L) map.row(0) *= -1.0L;
  for (int attempt = 0; attempt < kPerturbationAttempts; ++attempt) {
    auto parts = curvedParts(a, frame.rotation_a, b, frame.rotation_b, attempt);
    if (!parts) return {};
    parts->sum.map = map;
    parts->sum.centre = map * offset;
    const auto surface = placedSurface(*parts);
    if (!surface) continue;
    const double guess = guessOf(obstacle, direction);
    const SurfaceMass mass =
        with_gradient
            ? massAndMomentWithin(surface->patches, guess, interruption)
            : SurfaceMass{massWithin(surface->patches, guess, interruption), std::nullopt};
    const double inradius = parts->inradius / displacement.standardDeviations().maxCoeff();
    const LongVector3 middle =
        parts->sum.centre + map * (parts->sum.frame * parts->middle.cast<long double>());
    const auto share =
        shareBetween(surface->error, inradius * (1.0 - 8.0 * kEpsilon),
                     static_cast<double>(middle.norm()) * (1.0 + kEpsilon), mass.mass.lower);
    return share ? widened(mass, *share, map) : PairMass{};
  }
  return {};
}

}  // namespace fcl_prob::detail
