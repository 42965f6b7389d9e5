// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/unbounded_pair.h"

#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/decision.h"
#include "geometry/exact_sum.h"
#include "geometry/geometry_kind.h"
#include "query/line_intervals.h"

namespace fcl_prob::detail {
namespace {

/// { normal·x <= offset } or, a surface, { normal·x = offset }, for x relative to a point of the
/// world near it: far from the origin offsets would round.
struct Unbounded {
  Eigen::Vector3d normal;
  double offset;
  double error;  ///< of the offset
  bool surface;
};

/// \param moved  from the point that positions are relative to, to the origin of the shape
template <typename Shape>
Unbounded placed(const Shape& shape, const fcl::Transform3d& pose, const Eigen::Vector3d& moved,
                 bool surface) {
  const Eigen::Vector3d normal = pose.linear() * shape.n;
  const long double along = normal.cast<long double>().dot(moved.cast<long double>());
  // The normal is a sum of three products, whose rounding counts by the distance; the rest is
  // summed in long double and rounded once.
  const double error = 8 * kEpsilon * (std::fabs(shape.d) + moved.norm());
  return {normal, static_cast<double>(shape.d + along), error, surface};
}

Unbounded placed(const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose,
                 const Eigen::Vector3d& moved = Eigen::Vector3d::Zero()) {
  if (geometry.getNodeType() == fcl::GEOM_HALFSPACE) {
    return placed(static_cast<const fcl::Halfspaced&>(geometry), pose, moved, false);
  }
  return placed(static_cast<const fcl::Planed&>(geometry), pose, moved, true);
}

/// Where the displacement from its mean, along `normal`, leads to contact; the ends are known to
/// within `error`.
struct ContactSet {
  Eigen::Vector3d normal;
  std::vector<LineInterval> intervals;
  double error = 0.0;
};

/// Extents of the pieces along a world direction, relative to `offset`.
/// \param origin  of their part, relative to that of the plane
std::vector<LineInterval> extents(const PieceTree& tree, const fcl::Transform3d& pose,
                                  const LongVector& origin, const Unbounded& plane) {
  const long double at_origin = plane.normal.cast<long double>().dot(origin);
  const double base = static_cast<double>(at_origin - static_cast<long double>(plane.offset));
  const Eigen::Vector3d direction = pose.linear().transpose() * plane.normal;
  std::vector<LineInterval> result;
  for (const Eigen::Vector3i& triangle : tree.triangles) {
    double heights[3];
    for (int i = 0; i < 3; ++i) heights[i] = base + direction.dot(tree.vertices[triangle[i]]);
    const auto [least, most] = std::minmax_element(heights, heights + 3);
    result.push_back({*least, *most});
  }
  for (const PieceTree::Body& body : tree.bodies) {
    const SupportShape& shape = tree.shapes[body.shape].body;
    const double height = base + direction.dot(body.position);
    result.push_back(
        {height - shape.supportValue(-direction), height + shape.supportValue(direction)});
  }
  return result;
}

double errorOfExtents(const PieceTree& tree, const LongVector& origin, const Unbounded& plane) {
  // A height is a product of the normal, turned twice, with a vertex, and two sums: 16 ε of the
  // lengths.
  return plane.error + 2 * tree.error() +
         16 * kEpsilon *
             (tree.radius() + static_cast<double>(origin.norm()) + std::fabs(plane.offset));
}

/// A Halfspace reaches everything from the lowest point on.
std::vector<LineInterval> reached(std::vector<LineInterval> extents, const Unbounded& plane) {
  if (plane.surface || extents.empty()) return extents;
  double lowest = kInfinity;
  for (const LineInterval& extent : extents) lowest = std::min(lowest, extent.lo);
  return {{lowest, kInfinity}};
}

ContactSet contactWithBounded(const PlacedPair& pair, const Eigen::Vector3d& mean,
                              bool a_is_unbounded) {
  const PreparedGeometry& bounded = a_is_unbounded ? pair.b : pair.a;
  const fcl::Transform3d& pose = a_is_unbounded ? pair.pose_b : pair.pose_a;
  const fcl::Transform3d& pose_of_plane = a_is_unbounded ? pair.pose_a : pair.pose_b;
  const Unbounded plane =
      placed(a_is_unbounded ? pair.a.geometry() : pair.b.geometry(), pose_of_plane);
  const PieceTree& tree = bounded.pieces();
  ExactPosition position;
  position.add(pose, tree.parts[0].origin);
  position.add(pose_of_plane.translation(), -1.0);
  position.add(mean, a_is_unbounded ? -1.0 : 1.0);
  const LongVector origin = position.value();
  ContactSet set{plane.normal, reached(extents(tree, pose, origin, plane), plane),
                 errorOfExtents(tree, origin, plane)};
  if (a_is_unbounded) return set;
  // Moving the bounded one by s is moving the plane by -s.
  for (LineInterval& interval : set.intervals) interval = {-interval.hi, -interval.lo};
  return set;
}

/// Two half-spaces or planes: that of A is displaced.
ContactSet contactOfUnbounded(const Unbounded& a, const Unbounded& b) {
  const std::vector<LineInterval> always{{-kInfinity, kInfinity}};
  ContactSet set{a.normal, {}, a.error + b.error};
  const bool parallel = a.normal.cross(b.normal).squaredNorm() < kEpsilon;  // as FCL has it
  const bool same_side = a.normal.dot(b.normal) > 0.0;
  if (!parallel || (same_side && !a.surface && !b.surface)) {
    set.intervals = always;
    return set;
  }
  // In terms of x = normal_a·position: A reaches up to (or is at) offset_a + s, B up to, from or at
  // `of_b`.
  const double of_b = same_side ? b.offset : -b.offset;
  const double meeting = of_b - a.offset;
  if (a.surface && b.surface) {
    set.intervals = {{meeting, meeting}};
  } else if (a.surface) {
    set.intervals = same_side ? std::vector<LineInterval>{{-kInfinity, meeting}}
                              : std::vector<LineInterval>{{meeting, kInfinity}};
  } else {
    set.intervals = {{meeting, kInfinity}};
  }
  return set;
}

ContactSet contactSet(const PlacedPair& pair, const Eigen::Vector3d& mean) {
  const auto unbounded = [](const PreparedGeometry& geometry) {
    return kindOf(geometry.geometry()) == GeometryKind::unbounded;
  };
  if (!unbounded(pair.a)) return contactWithBounded(pair, mean, false);
  if (!unbounded(pair.b)) return contactWithBounded(pair, mean, true);
  ExactPosition from_a_to_b;
  from_a_to_b.add(pair.pose_b.translation());
  from_a_to_b.add(pair.pose_a.translation(), -1.0);
  from_a_to_b.add(mean, -1.0);
  return contactOfUnbounded(
      placed(pair.a.geometry(), pair.pose_a),
      placed(pair.b.geometry(), pair.pose_b, from_a_to_b.value().cast<double>()));
}

void fillGradient(const DisplacementAlong& along, const ContactSet& set,
                  ProbabilityResult& result) {
  const Bounds slope = along.slope(set.intervals, set.error);
  if (!std::isfinite(slope.width())) {
    result.plan.push_back("no gradient: the displacement does not move along the normal");
    return;
  }
  const Eigen::Vector3d middle = slope.middle() * set.normal;
  const Eigen::Vector3d half =
      (0.5 * slope.width() + 4 * kEpsilon * std::fabs(slope.middle())) * set.normal.cwiseAbs();
  result.gradient = middle;
  result.gradient_lower = middle - half;
  result.gradient_upper = middle + half;
}

// The interval of each piece grows and shrinks at its ends; from below only one of them counts,
// since the shapes may come apart where two of them meet.
Bounds massWithBands(const DisplacementAlong& along, const ContactSet& set,
                     const ProbabilityRequest& request) {
  const double length = (1.0 + 1e-12) * set.normal.norm();
  const double outward = length * (request.band_a.outward + request.band_b.outward);
  const double inward = length * (request.band_a.inward + request.band_b.inward);
  const auto rounding = [](double end) {
    return std::isinf(end) ? 0.0 : 4 * kEpsilon * std::fabs(end);
  };
  std::vector<LineInterval> possible;
  double lower = 0.0;
  for (const LineInterval& interval : set.intervals) {
    const double at_lo = rounding(interval.lo), at_hi = rounding(interval.hi);
    possible.push_back({interval.lo - outward - at_lo, interval.hi + outward + at_hi});
    const LineInterval certain{interval.lo + inward + at_lo, interval.hi - inward - at_hi};
    if (!(certain.lo < certain.hi)) continue;
    lower = std::max(lower, along.mass({certain}, set.error).lower);
  }
  return {lower, along.mass(possible, set.error).upper};
}

}  // namespace

ProbabilityResult unboundedPairProbability(const PlacedPair& pair,
                                           const GaussianDisplacement& displacement,
                                           const ProbabilityRequest& request) {
  // Open meshes are refused here as anywhere.
  pair.a.solid(request.contact);
  pair.b.solid(request.contact);
  const ContactSet set = contactSet(pair, displacement.mean());
  const DisplacementAlong along(displacement.withMean(Eigen::Vector3d::Zero()), set.normal);
  const Bounds mass =
      request.hasBand() ? massWithBands(along, set, request) : along.mass(set.intervals, set.error);
  ProbabilityResult result;
  result.method = ProbabilityMethod::exact;
  result.lower = mass.lower;
  result.upper = mass.upper;
  if (request.method == ProbabilityMethod::estimate) {
    result.estimate = mass.middle();
    result.standard_error = 0.5 * mass.width();
  }
  result.decision = decisionOf(mass, request);
  const bool is_narrow = mass.width() <= request.toleranceAt(mass.upper);
  const bool is_undecided = asksForDecision(request) && !isDecided(result.decision);
  if (is_narrow && !(is_undecided && request.hasBand())) {
    result.status = ProbabilityStatus::exact;
  } else {
    // Where nothing moves across a plane that is touched, rounding decides.
    result.status =
        request.hasBand() ? ProbabilityStatus::band_limit : ProbabilityStatus::resolution_limit;
  }
  if (request.gradient && request.hasBand()) {
    result.plan.push_back("no gradient beside a half-space or plane with bands");
  } else if (request.gradient) {
    fillGradient(along, set, result);
  }
  return result;
}

}  // namespace fcl_prob::detail
