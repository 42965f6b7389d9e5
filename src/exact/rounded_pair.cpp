// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/rounded_pair.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "base/constants.h"
#include "convex/minkowski_sum.h"
#include "geometry/exact_sum.h"
#include "mass/long_whitening.h"

namespace fcl_prob::detail {
namespace {

/// Of corners, next to the size of the bodies: two rotations and a sum of up to six vectors, each
/// coordinate of three products; a rotation that is one to 16 roundings.
constexpr double kShapeRoundings = 32.0;

/// Where parallel generators are taken for one, which they are to 45 roundings.
constexpr double kMergedRoundings = 96.0;

/// Of where the bodies are, and of long doubles that are made of that.
const double kFarRounding =
    std::max(16.0 * static_cast<double>(std::numeric_limits<long double>::epsilon()), 0x1p-58);

double ballRadius(const ConvexBody& body) {
  return body.set().rounded() ? body.set().rounded()->radius : 0.0;
}

bool isCoreWithBall(const ConvexBody& body) {
  return body.set().rounded() || body.set().isPolytope();
}

ConvexMesh coreMesh(const ConvexBody& body) {
  const ConvexSet& set = body.set();
  if (set.isPolytope()) return set.outerMesh();
  const std::vector<Eigen::Vector3d> corners = set.rounded()->core.corners();
  if (corners.size() > 2) return makeConvexMesh(corners);
  ConvexMesh mesh;
  mesh.vertices = corners;
  if (corners.size() == 2) mesh.edges = {{0, 1, -1, -1}};
  return mesh;
}

/// A core and how far it may be from the true one.
struct CoreFaces {
  FaceSet faces;
  double error = 0.0;
};

/// Of two sums of segments, about the difference of their centres; of a segment or a point only the
/// corners.
std::optional<CoreFaces> sumOfSegments(const PairFrame& frame, const Zonotope& a, const Zonotope& b,
                                       double size) {
  Zonotope core(Eigen::Vector3d::Zero());
  for (int i = 0; i < b.generatorCount(); ++i) core.addGenerator(frame.rotation_b * b.generator(i));
  for (int i = 0; i < a.generatorCount(); ++i) core.addGenerator(frame.rotation_a * a.generator(i));
  const bool merged = core.generatorCount() < a.generatorCount() + b.generatorCount();
  CoreFaces result;
  result.error = (merged ? kMergedRoundings : kShapeRoundings) * kEpsilon * size;
  if (core.generatorCount() > 1) {
    const auto defect = core.faces(result.faces);
    if (!defect) return std::nullopt;
    result.error += *defect;
    return result;
  }
  for (const Eigen::Vector3d& corner : core.corners()) result.faces.addVertex(corner);
  return result;
}

/// Where one of them is a polytope of its own, about the difference of the origins.
std::optional<CoreFaces> sumOfMeshes(const PairFrame& frame, const ConvexBody& a,
                                     const ConvexBody& b, double size,
                                     const Interruption& interruption) {
  ConvexMesh reflected;
  // The inverse, not the transpose: the matrices need not be rotations to the last bit.
  reflect(coreMesh(a), frame.rotation_b.inverse() * frame.rotation_a, reflected);
  MinkowskiSum sum;
  CoreFaces result;
  const auto defect = sum.compute(coreMesh(b), reflected, result.faces, interruption);
  if (!defect) return std::nullopt;
  result.faces.transform(frame.rotation_b, Eigen::Vector3d::Zero());
  result.error =
      2.0 * kShapeRoundings * kEpsilon * size + *defect + a.set().slack() + b.set().slack();
  return result;
}

Eigen::Vector3d centreOf(const ConvexBody& body, bool by_centre) {
  return by_centre ? body.set().rounded()->core.centre() : Eigen::Vector3d::Zero();
}

}  // namespace

bool isRoundedPair(const ConvexBody& a, const ConvexBody& b) {
  return ballRadius(a) + ballRadius(b) > 0.0 && isCoreWithBall(a) && isCoreWithBall(b);
}

PairMass roundedPairMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                         const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                         const RoundedEffort& effort) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  if (!frame.fits || frame.rank < 3) return {};
  const bool by_centre = a.set().rounded() && b.set().rounded();
  const double size = a.set().size() + b.set().size();
  auto core = by_centre
                  ? sumOfSegments(frame, a.set().rounded()->core, b.set().rounded()->core, size)
                  : sumOfMeshes(frame, a, b, size, effort.interruption);
  if (!core) return {};
  ExactPosition origin;
  origin.add(pose_b, centreOf(b, by_centre));
  origin.add(pose_a, centreOf(a, by_centre), -1.0);
  origin.add(displacement.mean(), -1.0);
  // In a unit next to the sizes: powers of two lose nothing, and no product is out of range.
  const double unit = powerOfTwoAt(size);
  core->faces.transform(Eigen::Matrix3d::Identity() / unit, Eigen::Vector3d::Zero());
  RoundedPolytope body;
  body.core = toClosedPolytope(core->faces);
  body.origin = origin.value() / unit;
  body.radius = (ballRadius(a) + ballRadius(b)) / unit;
  body.error = core->error / unit +
               body.radius * (frame.ball_stretch + kShapeRoundings * kEpsilon) +
               kFarRounding * static_cast<double>(body.origin.norm());
  const LongMatrix3 whitening = unit * longWhitening(displacement);
  const RoundedMass mass = roundedPolytopeMass(body, whitening, effort);
  PairMass result{mass.mass, std::nullopt};
  if (mass.moment) result.gradient = gradientOf(*mass.moment, whitening.cast<double>() / unit);
  return result;
}

}  // namespace fcl_prob::detail
