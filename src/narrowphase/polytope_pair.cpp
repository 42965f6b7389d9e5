// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "narrowphase/polytope_pair.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "cobstacle/minkowski_sum.h"
#include "gaussian/agreed_bounds.h"
#include "gaussian/polytope_effort.h"
#include "geometry/exact_sum.h"
#include "narrowphase/long_whitening.h"
#include "narrowphase/shell_reach.h"

namespace fcl_prob::detail {
namespace {

/// Of a corner, next to the lengths that it is a sum of, in halves of kLongEpsilon: 5.2 for a
/// rotation (three products and √3), 6 for sums of generators and of positions, 2 for where these
/// are; 7.2 for whitening and 14 for its matrix, of three products with what is right to 5. That is
/// 34.4.
constexpr double kCornerRoundings = 24.0;

/// By what share the mass may be larger than that of the faces found.
constexpr double kMostGrowth = 1e-6;

/// Two bodies in world axes, B about its own origin, A reflected about its own.
struct WorldPair {
  LongPoints of_b, minus_a;
  LongVector3 origin;
  double slack;  ///< how far they may reach out of the hulls of their points (metres)
};

/// What may be between the mass of the C-obstacle and that of the faces found: a share of it, and
/// what they go around once more or less.
struct Growth {
  double share, folds;
};

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

/// The faces of a C-obstacle about the difference of the origins, whose corners are sums of two.
struct SummedFaces {
  FaceSet faces;
  LongPoints corners;
};

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
  // The inverse, not the transpose: the matrices need not be rotations to the last bit.
  reflect(a.set().outerMesh(), frame.rotation_b.inverse() * frame.rotation_a, reflected);
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

LongVector3 middleOf(const LongPolytope& body) {
  LongVector3 sum = LongVector3::Zero();
  for (const LongVector3& v : body.vertices) sum += v;
  return sum / static_cast<long double>(body.vertices.size());
}

class PolytopePair {
 public:
  PolytopePair(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
               const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement)
      : a_(a), b_(b), frame_(pairFrame(a, pose_a, b, pose_b, displacement)) {
    ExactPosition origin;
    origin.add(pose_b.translation());
    origin.add(pose_a.translation(), -1.0);
    origin.add(displacement.mean(), -1.0);
    pair_.origin = origin.value();
    pair_.slack = a.set().slack() + b.set().slack();
    pair_.of_b = turned(cornersOf(b), frame_.rotation_b);
    pair_.minus_a = turned(cornersOf(a), frame_.rotation_a);
    for (LongVector3& p : pair_.minus_a) p = -p;
    whitening_ = longWhitening(displacement);
  }

  std::optional<PairMass> answer(bool with_gradient, const Interruption& interruption) {
    if (!frame_.fits || frame_.rank < 3) return std::nullopt;
    const auto summed =
        a_.set().rounded() && b_.set().rounded()
            ? facesOfBoxes(frame_, a_.set().rounded()->core, b_.set().rounded()->core)
            : facesOfMeshes(frame_, a_, b_, interruption);
    if (!summed || summed->faces.faceCount() < 4) return std::nullopt;
    const LongPolytope body = whitened(*summed);
    const HeavyPart heavy = heavyPart(body);
    const auto growth = growthOf(body, middleOf(heavy.polytope));
    if (!growth) return std::nullopt;
    PairMass result;
    result.mass = polytopeMass(heavy, rounding(), {0.0, interruption});
    // Off the lower bound, too, for the folds; and the middle stays the best value.
    const double between =
        (growth->share * result.mass.upper + growth->folds) * (1.0 + 4.0 * kEpsilon);
    result.mass.lower = std::max(0.0, result.mass.lower - between);
    result.mass.upper = std::min(1.0, result.mass.upper + between);
    if (!with_gradient) return result;
    VectorBounds moment = withinBody(polytopeMoment(heavy, rounding()), body, result.mass);
    // Beyond, no mass can be told from nothing.
    moment.lower.array() -= kOutermostMoment * between;
    moment.upper.array() += kOutermostMoment * between;
    result.gradient = gradientOf(moment, whitening_.cast<double>());
    return result;
  }

 private:
  LongPolytope whitened(const SummedFaces& summed) const {
    LongPolytope body;
    for (const LongVector3& corner : summed.corners) {
      body.vertices.push_back(whitening_ * (corner + pair_.origin));
    }
    for (std::size_t f = 0; f < summed.faces.faceCount(); ++f) {
      std::vector<int> loop;
      for (int k = 0; k < summed.faces.cornerCount(f); ++k) {
        loop.push_back(summed.faces.corner(f, k));
      }
      body.faces.push_back({LongVector3::UnitX(), std::move(loop)});
    }
    body.findNormals();
    return body;
  }

  /// Of a small body, of whose faces little is left, the mean is known from where its corners are:
  /// that of what the faces enclose.
  VectorBounds withinBody(const VectorBounds& moment, const LongPolytope& body,
                          const Bounds& mass) const {
    const Eigen::Vector3d beyond = 2.0 * rounding();
    VectorBounds result = moment;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax_element(
          body.vertices.begin(), body.vertices.end(),
          [k](const LongVector3& v, const LongVector3& w) { return v[k] < w[k]; });
      const double lo = static_cast<double>((*low)[k]), hi = static_cast<double>((*high)[k]);
      const double error = beyond[k] + kEpsilon * std::max(std::abs(lo), std::abs(hi));
      const double least = (lo - error) * (lo < error ? mass.upper : mass.lower);
      const double most = (hi + error) * (hi > -error ? mass.upper : mass.lower);
      const double rounded = 4.0 * kEpsilon * std::max(std::abs(least), std::abs(most));
      const Bounds both = agreed({moment.lower[k], moment.upper[k]},
                                 {least - rounded - kUnderflow, most + rounded + kUnderflow});
      result.lower[k] = both.lower;
      result.upper[k] = both.upper;
    }
    return result;
  }

  /// Of a corner in the whitened frame, along each axis.
  Eigen::Vector3d rounding() const {
    const double sum = a_.set().size() + b_.set().size() + static_cast<double>(pair_.origin.norm());
    return whitenedLength(kCornerRoundings * kLongEpsilon * sum);
  }

  /// By how much a length can change each whitened coordinate.
  Eigen::Vector3d whitenedLength(double metres) const {
    return (1.0 + kEpsilon) * metres * whitening_.rowwise().norm().cast<double>();
  }

  /// All corners found are sums of corners, so that the surface S through them is within V. What
  /// is within c + λ(V - c) weighs at least λ³ exp(-(1 - λ) s) of V, where s is |c|²/2, |·|² being
  /// convex, or |c| times the largest |y - c|.
  std::optional<Growth> growthOf(const LongPolytope& body, const LongVector3& middle) const {
    ShellReach reach(body, middle, 2.0 * rounding() + whitenedLength(pair_.slack));
    const auto beyond = reach.share(
        {whitenedPoints(pair_.of_b), whitenedPoints(pair_.minus_a), whitening_ * pair_.origin});
    if (!beyond) return std::nullopt;
    long double farthest = 0.0L;
    for (const LongVector3& v : body.vertices) farthest = std::max(farthest, (v - middle).norm());
    const double distance = static_cast<double>(middle.norm());
    const double slope =
        distance * std::min(0.5 * distance, static_cast<double>(farthest) * (1.0 + 2.0 * *beyond));
    const double share = 1.01 * *beyond * (3.0 + slope);
    if (!(share < kMostGrowth)) return std::nullopt;
    return Growth{share, reach.foldMass(*beyond)};
  }

  LongPoints whitenedPoints(const LongPoints& points) const {
    LongPoints result;
    for (const LongVector3& p : points) result.push_back(whitening_ * p);
    return result;
  }

  const ConvexBody &a_, &b_;
  PairFrame frame_;
  WorldPair pair_;
  LongMatrix3 whitening_;
};

}  // namespace

std::optional<PairMass> polytopePairMass(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                         const ConvexBody& b, const fcl::Transform3d& pose_b,
                                         const GaussianDisplacement& displacement,
                                         bool with_gradient, const Interruption& interruption) {
  return PolytopePair(a, pose_a, b, pose_b, displacement).answer(with_gradient, interruption);
}

}  // namespace fcl_prob::detail
