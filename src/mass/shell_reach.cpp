// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/shell_reach.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

/// A share of a body's height that is worth no search for another normal.
constexpr long double kGoodShare = 1e-12L;

/// What is farther out weighs less than the least double.
constexpr long double kOutermostShell = 42.0L;

/// (2π)^(-3/2), rounded up.
constexpr double kLargestDensity = 0.0635;

long double highest(const LongPoints& points, const LongVector3& direction) {
  long double most = -kInfinity;
  for (const LongVector3& p : points) most = std::max(most, direction.dot(p));
  return most;
}

/// From the origin to a segment.
long double distanceToSegment(const LongVector3& from, const LongVector3& to) {
  const LongVector3 along = to - from;
  const long double square = along.squaredNorm();
  const long double t = square > 0.0L ? std::clamp(-from.dot(along) / square, 0.0L, 1.0L) : 0.0L;
  return (from + t * along).norm();
}

/// The sum of the sizes of what a determinant is the sum of.
long double permanent(const LongMatrix3& m) {
  return m(0, 0) * (m(1, 1) * m(2, 2) + m(1, 2) * m(2, 1)) +
         m(0, 1) * (m(1, 0) * m(2, 2) + m(1, 2) * m(2, 0)) +
         m(0, 2) * (m(1, 0) * m(2, 1) + m(1, 1) * m(2, 0));
}

}  // namespace

long double DifferenceBody::reach(const LongVector3& direction) const {
  return highest(of_b, direction) + highest(minus_a, direction) + direction.dot(origin);
}

ShellReach::ShellReach(const LongPolytope& surface, const LongVector3& middle,
                       const Eigen::Vector3d& rounding)
    : surface_(surface), middle_(middle), rounding_(rounding.cast<long double>()) {}

std::optional<double> ShellReach::share(const DifferenceBody& body) {
  reach_.clear();
  for (const LongPolytope::Face& face : surface_.faces) reach_.push_back(body.reach(face.normal));
  long double most = 0.0L;
  for (std::size_t f = 0; f < surface_.faces.size(); ++f) {
    long double share = shareAlong(f, f);
    // The normal of a sliver says little: any other one says something of it.
    for (std::size_t g = 0; share > kGoodShare && g < surface_.faces.size(); ++g) {
      share = std::min(share, shareAlong(f, g));
    }
    most = std::max(most, share);
  }
  if (!(most < 1.0L)) return std::nullopt;
  return static_cast<double>(most) * (1.0 + 1e-9);
}

/// For what is beyond face f, by the normal of face g.
long double ShellReach::shareAlong(std::size_t f, std::size_t g) const {
  const LongVector3& normal = surface_.faces[g].normal;
  long double least = kInfinity;
  for (const int k : surface_.faces[f].vertices) {
    least = std::min(least, normal.dot(surface_.vertices[static_cast<std::size_t>(k)]));
  }
  const long double rounding = normal.cwiseAbs().dot(rounding_);
  const long double height = least - normal.dot(middle_) - rounding;
  return height > 0.0L ? (reach_[g] - least + rounding) / height : kInfinity;
}

LongVector3 ShellReach::fromMiddle(int vertex) const {
  return surface_.vertices[static_cast<std::size_t>(vertex)] - middle_;
}

double ShellReach::foldMass(double share) const {
  double mass = 0.0;
  for (const LongPolytope::Face& face : surface_.faces) {
    for (std::size_t k = 2; k < face.vertices.size(); ++k) {
      mass += foldMass({fromMiddle(face.vertices[0]), fromMiddle(face.vertices[k - 1]),
                        fromMiddle(face.vertices[k])},
                       share);
    }
  }
  return mass;
}

/// In a direction in which the triangle is at x from c, V ends at (1 + share) x or before, and the
/// shell begins at x / (1 + share) or later: so it is (1 + share)³ - (1 + share)⁻³ of the
/// tetrahedron, and no farther from the triangle than the share of that distance. Of a long
/// triangle only what is within reach counts, of which the base is no larger than its width times
/// twice that.
double ShellReach::foldMass(const Triangle& triangle, double share) const {
  const auto& [p, q, r] = triangle;
  const LongVector3 first = q - p, second = r - p;
  const long double a = first.norm(), b = second.norm(), c = p.norm(), moved = rounding_.norm();
  const long double volume = first.cross(second).dot(p);
  const long double rounding = roundingOfVolume(triangle);
  if (volume > rounding) return 0.0;
  const long double distance = std::min({distanceToSegment(p + middle_, q + middle_),
                                         distanceToSegment(p + middle_, r + middle_),
                                         distanceToSegment(q + middle_, r + middle_)});
  const long double longest = std::max({a, b, (r - q).norm()});
  // No point of a triangle is farther from its edges than this.
  const long double width = longest > 0.0L ? first.cross(second).norm() / longest : 0.0L;
  const long double apart = width + 2.0L * moved + share * (c + longest + moved);
  const double near = static_cast<double>(std::max(0.0L, distance - apart)) * (1.0 - 1e-12);
  const long double reach = (kOutermostShell + middle_.norm()) * (1.0L + share) + 2.0L * moved;
  const long double most =
      std::min(std::abs(volume) + rounding, 4.0L * reach * reach * (width + 2.0L * moved));
  return 1.01 * kLargestDensity * share * static_cast<double>(most) * std::exp(-0.5 * near * near);
}

/// Along each axis sides are rounded by twice what points are. A determinant is linear in every
/// entry, whatever the units of the axes: deviations far apart do not count for each other.
long double ShellReach::roundingOfVolume(const Triangle& triangle) const {
  const auto& [p, q, r] = triangle;
  LongMatrix3 sizes, moved;
  sizes << (q - p).cwiseAbs(), (r - p).cwiseAbs(), p.cwiseAbs();
  moved = sizes + 2.0L * rounding_ * LongVector3::Ones().transpose();
  const long double most = permanent(moved);
  return (most - permanent(sizes)) + 32.0L * static_cast<long double>(kLongEpsilon) * most;
}

}  // namespace fcl_prob::detail
