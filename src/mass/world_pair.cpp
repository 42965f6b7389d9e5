// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/world_pair.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "convex/minkowski_sum.h"
#include "geometry/exact_sum.h"

namespace fcl_prob::detail {
namespace {

/// Of a corner, next to the lengths that it is a sum of, in halves of kLongEpsilon: 5.2 for a
/// rotation (three products and √3), 6 for sums of generators and of positions, 2 for where these
/// are; 7.2 for whitening and 14 for its matrix, of three products with what is right to 5. That is
/// 34.4.
constexpr double kCornerRoundings = 24.0;

std::vector<Eigen::Vector3d> cornersOf(const ConvexBody& body) {
  const auto& rounded = body.set().rounded();
  return rounded ? rounded->core.corners() : body.set().outerMesh().vertices;
}

LongPoints turned(const std::vector<Eigen::Vector3d>& points, const Eigen::Matrix3d& rotation) {
  LongPoints result;
  for (const Eigen::Vector3d& p : points) {
    result.push_back(rotation.cast<long double>() * p.cast<long double>());
  }
  return result;
}

/// Sums of segments: no two parallel faces of two boxes are told apart by rounding.
std::optional<SummedFaces> facesOfBoxes(const PairFrame& frame, const Zonotope& a,
                                        const Zonotope& b) {
  Zonotope sum(Eigen::Vector3d::Zero());
  LongPoints generators;
  const auto add = [&](const Zonotope& box, const Eigen::Matrix3d& rotation) {
    for (int i = 0; i < box.generatorCount(); ++i) {
      const Zonotope::Place place = sum.addGenerator(rotation * box.generator(i));
      if (place.generator < 0) continue;
      const LongVector3 generator =
          rotation.cast<long double>() * box.generator(i).cast<long double>();
      const auto index = static_cast<std::size_t>(place.generator);
      if (index == generators.size()) generators.push_back(LongVector3::Zero());
      generators[index] += static_cast<long double>(place.sign) * generator;
    }
  };
  add(b, frame.rotation_b);
  add(a, frame.rotation_a);
  SummedFaces result;
  std::vector<unsigned> signs;
  if (!sum.faces(result.faces, &signs)) return std::nullopt;
  for (const unsigned sign : signs) {
    LongVector3 corner = LongVector3::Zero();
    for (std::size_t i = 0; i < generators.size(); ++i) {
      corner += (sign >> i) & 1u ? generators[i] : LongVector3(-generators[i]);
    }
    result.corners.push_back(corner);
  }
  return result;
}

std::optional<SummedFaces> facesOfMeshes(const PairFrame& frame, const ConvexBody& a,
                                         const ConvexBody& b, const Interruption& interruption) {
  const ConvexMesh& mesh_b = b.set().outerMesh();
  ConvexMesh reflected;
  // The inverse, not the transpose: the matrices need not be rotations to the last bit. Rounding
  // would tell parallel faces apart.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (!frame.same_rotation) turn = frame.rotation_b.inverse() * frame.rotation_a;
  reflect(a.set().outerMesh(), turn, reflected);
  MinkowskiSum sum;
  SummedFaces result;
  if (!sum.compute(mesh_b, reflected, result.faces, interruption)) return std::nullopt;
  const LongPoints of_b = turned(mesh_b.vertices, frame.rotation_b);
  const LongPoints of_a = turned(a.set().outerMesh().vertices, frame.rotation_a);
  for (const auto& [i, j] : sum.vertexPairs(result.faces)) {
    result.corners.push_back(of_b[static_cast<std::size_t>(i)] - of_a[static_cast<std::size_t>(j)]);
  }
  return result;
}

long double highest(const LongPoints& points, const LongVector3& direction) {
  long double most = -std::numeric_limits<long double>::infinity();
  for (const LongVector3& p : points) most = std::max(most, direction.dot(p));
  return most;
}

}  // namespace

long double DifferenceBody::reach(const LongVector3& direction) const {
  return highest(of_b, direction) + highest(minus_a, direction) + direction.dot(origin);
}

WorldPair worldPair(const PairFrame& frame, const ConvexBody& a, const fcl::Transform3d& pose_a,
                    const ConvexBody& b, const fcl::Transform3d& pose_b,
                    const GaussianDisplacement& displacement, double inset) {
  WorldPair pair;
  ExactPosition origin;
  origin.add(pose_b.translation());
  origin.add(pose_a.translation(), -1.0);
  origin.add(displacement.mean(), -1.0);
  pair.origin = origin.value();
  pair.slack = a.set().slack() + b.set().slack();
  pair.of_b = turned(cornersOf(b), frame.rotation_b);
  pair.minus_a = turned(cornersOf(a), frame.rotation_a);
  for (LongVector3& p : pair.minus_a) p = -p;
  const double sum = a.set().size() + b.set().size() + static_cast<double>(pair.origin.norm());
  pair.rounding = kCornerRoundings * kLongEpsilon * sum + inset;
  return pair;
}

std::optional<SummedFaces> summedFaces(const PairFrame& frame, const ConvexBody& a,
                                       const ConvexBody& b, const Interruption& interruption) {
  if (a.set().rounded() && b.set().rounded()) {
    return facesOfBoxes(frame, a.set().rounded()->core, b.set().rounded()->core);
  }
  return facesOfMeshes(frame, a, b, interruption);
}

}  // namespace fcl_prob::detail
