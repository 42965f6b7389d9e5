// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/rounded_polytope_mass.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/constants.h"
#include "mass/part_cubature.h"
#include "mass/polytope_effort.h"
#include "mass/rounded_parts.h"

namespace fcl_prob::detail {
namespace {

/// Of the error of all rules, next to the mass.
constexpr double kRoundedTarget = 1e-10;
constexpr double kRoundedEnough = 4e-10;
constexpr int kRoundedAttempts = 3;
constexpr std::size_t kMostRoundedFaces = 4000;
constexpr std::size_t kMostBoxes = 10000;

/// Of the core's own width: it weighs no more than the whole.
constexpr double kCoreEnough = 1e-10;

/// Of sums over all boxes and faces.
constexpr double kSumRounding = 2e4 * kEpsilon;

/// In deviations: a larger body would only exhaust the boxes.
constexpr double kLargestBody = 3e4;

/// Of the mass: by how much a body may be known to grow at the most, to be computed once only.
constexpr double kSmallGrowth = 2e-11;

/// A core that weighs so much tells well enough what the whole weighs.
constexpr double kKnownMass = 0.02;

/// Where the density is less than the smallest double.
constexpr double kOutermost = 39.0;

struct CoreMass {
  Bounds mass{0.0, 0.0};
  VectorBounds moment;
};

bool isSolid(const ConvexPolytope& core) { return core.faces.size() > 3; }

ConvexPolytope whitenedCore(const RoundedPolytope& body,
                            const std::vector<Eigen::Vector3d>& normals,
                            const LongMatrix3& whitening) {
  ConvexPolytope image = body.core;
  for (Eigen::Vector3d& v : image.vertices) v = whitened(whitening, v, body.origin);
  // Normals go by the inverse transpose, here times the square of the largest deviation.
  const LongMatrix3 inverse = whitening.inverse();
  const LongMatrix3 map = (inverse / inverse.cwiseAbs().maxCoeff()).transpose();
  for (std::size_t f = 0; f < normals.size(); ++f) {
    image.faces[f].normal = whitened(map, normals[f]).stableNormalized();
  }
  return image;
}

CoreMass coreMass(const RoundedPolytope& body, const std::vector<Eigen::Vector3d>& normals,
                  const LongMatrix3& whitening, const RoundedEffort& effort) {
  CoreMass result;
  if (!isSolid(body.core)) return result;
  const ConvexPolytope image = whitenedCore(body, normals, whitening);
  double farthest = 0.0;
  for (const Eigen::Vector3d& v : image.vertices) farthest = std::max(farthest, v.norm());
  const double rounding = kEpsilon * farthest;
  result.mass = polytopeMass(image, rounding, {kCoreEnough, effort.interruption});
  if (effort.moment) result.moment = polytopeMoment(image, rounding);
  return result;
}

double nearestOfSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp(-a.dot(along) / square, 0.0, 1.0) : 0.0;
  return (a + t * along).squaredNorm();
}

/// |c|² of some point of the core, whitened; not far more than the least.
double nearSquare(const RoundedPolytope& body, const LongMatrix3& whitening) {
  const ConvexPolytope& core = body.core;
  const auto at = [&](std::size_t k) -> Eigen::Vector3d {
    return whitened(whitening, core.vertices[k], body.origin);
  };
  double least = at(0).squaredNorm();
  if (core.faces.empty() && core.vertices.size() == 2) return nearestOfSegment(at(0), at(1));
  for (const ConvexPolytope::Face& face : core.faces) {
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      const auto from = static_cast<std::size_t>(face.vertices[k]);
      const auto to = static_cast<std::size_t>(face.vertices[(k + 1) % face.vertices.size()]);
      least = std::min(least, nearestOfSegment(at(from), at(to)));
    }
  }
  return least;
}

/// No less than about half of the body's length in deviations, along whichever axis.
double extentOf(const RoundedPolytope& body, const LongMatrix3& whitening) {
  double longest = body.radius;
  for (const Eigen::Vector3d& v : body.core.vertices) {
    longest = std::max(longest, (v - body.core.vertices[0]).norm() + body.radius);
  }
  return longest * static_cast<double>(whitening.norm());
}

class RoundedMassQuery {
 public:
  RoundedMassQuery(const RoundedPolytope& body, const LongMatrix3& whitening,
                   const RoundedEffort& effort)
      : body_(body), whitening_(whitening), effort_(effort) {}

  RoundedMass answer() {
    if (body_.core.faces.size() > kMostRoundedFaces) return {};
    if (!(extentOf(body_, whitening_) <= kLargestBody)) return {};
    std::optional<RoundedParts> parts = roundedParts(body_.core, body_.origin, whitening_);
    if (!parts) return {};
    parts_ = std::move(*parts);
    core_ = coreMass(body_, parts_.normals, whitening_, effort_);
    // Normals are unit vectors up to a few roundings.
    const double inner = (body_.radius - body_.error) * (1.0 - 8.0 * kEpsilon);
    const double outer = (body_.radius + body_.error + parts_.defect) * (1.0 + 8.0 * kEpsilon);
    if (!(inner > 0.0)) return {};
    const SolidSum least = sumUpTo(inner);
    const Bounds below = massOf(least);
    const double growth = (outer - inner) / inner * steepness(below) * 1.001;
    if (growth <= kSmallGrowth) {
      return resultOf(below, least, {below.lower, below.upper * (1.0 + 1.001 * growth)});
    }
    const SolidSum most = sumUpTo(outer);
    return resultOf(below, least, {below.lower, massOf(most).upper});
  }

 private:
  Bounds massOf(const SolidSum& sum) const {
    const double rounding = kSumRounding * (sum.mass + core_.mass.upper);
    return {core_.mass.lower + sum.mass - sum.error - rounding,
            core_.mass.upper + sum.mass + sum.error + rounding + kUnderflow};
  }

  /// By how much, at the most, the log of the mass of V(r) grows with the log of r, from where that
  /// mass is known to another radius next to it. V(inner) holds c + λ (V(outer) - c), λ =
  /// inner/outer, for any c of the core, of which the mass is at least λ³ exp(-(1 - λ) |c|²/2) that
  /// of V(outer), |·|² being convex. And in r that log is concave (Prékopa 1973): it grows no
  /// faster than on the way from the core alone.
  double steepness(const Bounds& mass) const {
    const double of_scale = 3.0 + 0.5 * nearSquare(body_, whitening_);
    if (!(core_.mass.lower > kUnderflow)) return of_scale;
    return std::min(of_scale, std::log(mass.upper / core_.mass.lower) * (1.0 + 1e-9) + 1e-9);
  }

  RoundedMass resultOf(const Bounds& of_moment, const SolidSum& sum, const Bounds& mass) const {
    RoundedMass result;
    if (!(mass.lower <= mass.upper)) return result;
    result.mass = {std::clamp(mass.lower, 0.0, 1.0), std::min(mass.upper, 1.0)};
    if (!effort_.moment) return result;
    // What is between the inner body and the true one weighs no more than the mass's bounds tell.
    const double between = std::max(0.0, mass.upper - of_moment.lower);
    const double error =
        sum.moment_error + kOutermost * (between + kSumRounding * mass.upper) + kUnderflow;
    if (!std::isfinite(error)) return result;
    result.moment.emplace();
    result.moment->lower = (core_.moment.lower + sum.moment).array() - error;
    result.moment->upper = (core_.moment.upper + sum.moment).array() + error;
    return result;
  }

  /// The parts up to a radius. What the tolerance is a share of is only guessed at first.
  SolidSum sumUpTo(double radius) {
    parts_.setRadius(radius);
    const bool known = core_.mass.lower >= kKnownMass;
    double about = std::max(core_.mass.lower, known ? 0.0 : roughMass(parts_.parts));
    about = std::max(about, kUnderflow);
    SolidSum best;
    best.error = best.moment_error = kInfinity;
    for (int attempt = 0; attempt < kRoundedAttempts; ++attempt) {
      const PartCubature cubature = cubatureWithin(kRoundedTarget * about);
      if (cubature.sum().error < best.error) best = cubature.sum();
      const double mass = core_.mass.lower + best.mass;
      if (best.error <= kRoundedEnough * mass || cubature.exhausted()) break;
      // As far as it is known.
      const double next = mass > 2.0 * best.error ? mass : 1e-6 * about;
      if (!(next < 0.5 * about) || isDue(effort_.interruption)) break;
      about = next;
    }
    return best;
  }

  PartCubature cubatureWithin(double tolerance) const {
    const double count = static_cast<double>(parts_.parts.size());
    PartCubature cubature({tolerance / (count + 30.0), kMostBoxes});
    for (const AnyPart& part : parts_.parts) {
      if (isDue(effort_.interruption)) {
        cubature.leave();
        break;
      }
      cubature.add(part);
    }
    return cubature;
  }

  const RoundedPolytope& body_;
  const LongMatrix3& whitening_;
  const RoundedEffort& effort_;
  RoundedParts parts_;
  CoreMass core_;
};

}  // namespace

RoundedMass roundedPolytopeMass(const RoundedPolytope& body, const LongMatrix3& whitening,
                                const RoundedEffort& effort) {
  return RoundedMassQuery(body, whitening, effort).answer();
}

}  // namespace fcl_prob::detail
