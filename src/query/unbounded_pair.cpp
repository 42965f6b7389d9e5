// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/unbounded_pair.h"

#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "gaussian/constants.h"
#include "geometry/geometry_kind.h"
#include "query/line_intervals.h"
#include "query/single_collide.h"

namespace fcl_prob::detail {
namespace {

using LongVector = Eigen::Matrix<long double, 3, 1>;

/// { normal·x <= offset } or, a surface, { normal·x = offset } in the world frame.
struct Unbounded {
  Eigen::Vector3d normal;
  double offset;
  double error;  ///< of the offset
  bool surface;
};

template <typename Shape>
Unbounded placed(const Shape& shape, const fcl::Transform3d& pose, bool surface) {
  const Eigen::Vector3d normal = pose.linear() * shape.n;
  const LongVector translation = pose.translation().cast<long double>();
  const long double moved = normal.cast<long double>().dot(translation);
  const double error = 8 * kEpsilon * (std::fabs(shape.d) + pose.translation().norm());
  return {normal, static_cast<double>(shape.d + moved), error, surface};
}

Unbounded placed(const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose) {
  if (geometry.getNodeType() == fcl::GEOM_HALFSPACE) {
    return placed(static_cast<const fcl::Halfspaced&>(geometry), pose, false);
  }
  return placed(static_cast<const fcl::Planed&>(geometry), pose, true);
}

/// Where the displacement, along `normal`, leads to contact; the ends are known to within `error`.
struct ContactSet {
  Eigen::Vector3d normal;
  std::vector<LineInterval> intervals;
  double error = 0.0;
};

/// Extents of the pieces along a world direction, relative to `offset`.
std::vector<LineInterval> extents(const PieceTree& tree, const fcl::Transform3d& pose,
                                  const Unbounded& plane) {
  const LongVector origin =
      pose.linear().cast<long double>() * tree.parts[0].origin.cast<long double>() +
      pose.translation().cast<long double>();
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

double errorOfExtents(const PieceTree& tree, const fcl::Transform3d& pose, const Unbounded& plane) {
  return plane.error + 16 * kEpsilon *
                           (tree.radius() + tree.parts[0].origin.norm() +
                            pose.translation().norm() + std::fabs(plane.offset));
}

/// A Halfspace reaches everything from the lowest point on.
std::vector<LineInterval> reached(std::vector<LineInterval> extents, const Unbounded& plane) {
  if (plane.surface || extents.empty()) return extents;
  double lowest = kInfinity;
  for (const LineInterval& extent : extents) lowest = std::min(lowest, extent.lo);
  return {{lowest, kInfinity}};
}

ContactSet contactWithBounded(const PlacedPair& pair, bool a_is_unbounded) {
  const PreparedGeometry& bounded = a_is_unbounded ? pair.b : pair.a;
  const fcl::Transform3d& pose = a_is_unbounded ? pair.pose_b : pair.pose_a;
  const Unbounded plane = a_is_unbounded ? placed(pair.a.geometry(), pair.pose_a)
                                         : placed(pair.b.geometry(), pair.pose_b);
  const PieceTree& tree = bounded.pieces();
  ContactSet set{plane.normal, reached(extents(tree, pose, plane), plane),
                 errorOfExtents(tree, pose, plane)};
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

ContactSet contactSet(const PlacedPair& pair) {
  const auto unbounded = [](const PreparedGeometry& geometry) {
    return kindOf(geometry.geometry()) == GeometryKind::unbounded;
  };
  if (!unbounded(pair.a)) return contactWithBounded(pair, false);
  if (!unbounded(pair.b)) return contactWithBounded(pair, true);
  return contactOfUnbounded(placed(pair.a.geometry(), pair.pose_a),
                            placed(pair.b.geometry(), pair.pose_b));
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

}  // namespace

ProbabilityResult unboundedPairProbability(const PlacedPair& pair,
                                           const GaussianDisplacement& displacement,
                                           const ProbabilityRequest& request) {
  // Open meshes are refused here as anywhere.
  pair.a.solid(request.contact);
  pair.b.solid(request.contact);
  const ContactSet set = contactSet(pair);
  const DisplacementAlong along(displacement, set.normal);
  const Bounds mass = along.mass(set.intervals, set.error);
  ProbabilityResult result;
  result.method = ProbabilityMethod::exact;
  result.lower = mass.lower;
  result.upper = mass.upper;
  if (request.method == ProbabilityMethod::estimate) {
    result.estimate = mass.middle();
    result.standard_error = 0.5 * mass.width();
  }
  const double tolerance =
      std::max(request.absolute_tolerance, request.relative_tolerance * mass.upper);
  // Where nothing moves across a plane that is touched, rounding decides.
  result.status =
      mass.width() <= tolerance ? ProbabilityStatus::exact : ProbabilityStatus::resolution_limit;
  result.decision = decisionOf(mass, request);
  if (request.gradient) fillGradient(along, set, result);
  return result;
}

}  // namespace fcl_prob::detail
