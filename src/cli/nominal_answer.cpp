// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/nominal_answer.h"

#include <fcl/narrowphase/distance.h>

#include <cmath>

#include "fcl_prob/monte_carlo.h"
#include "geometry/displaced_collider.h"
#include "geometry/geometry_kind.h"

namespace fcl_prob::cli {
namespace {

bool bounded(const Geometry& geometry) {
  const detail::GeometryKind kind = detail::kindOf(*geometry);
  return kind == detail::GeometryKind::mesh || kind == detail::GeometryKind::convex;
}

/// FCL's GJK has no support function for unbounded shapes, and throws on some degenerate ones.
std::optional<double> distanceBetween(const Geometry& a, const fcl::Transform3d& pose_a,
                                      const Geometry& b, const fcl::Transform3d& pose_b) {
  if (!bounded(a) || !bounded(b)) return std::nullopt;
  fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  try {
    fcl::distance(a.get(), pose_a, b.get(), pose_b, request, result);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  if (!std::isfinite(result.min_distance) || result.min_distance < 0.0) return std::nullopt;
  return result.min_distance;
}

}  // namespace

NominalAnswer nominalAnswer(const Geometry& a, const fcl::Transform3d& pose_a, const Geometry& b,
                            const fcl::Transform3d& pose_b, const Eigen::Vector3d& mean) {
  NominalAnswer answer;
  if (!fclSupportsPair(*a, *b)) return answer;
  const detail::DisplacedCollider collider(*a, pose_a, *b, pose_b, ContactMeaning::fcl);
  answer.collides = collider.collides(mean);
  fcl::Transform3d displaced = pose_a;
  displaced.pretranslate(mean);
  answer.distance = *answer.collides ? 0.0 : distanceBetween(a, displaced, b, pose_b);
  return answer;
}

}  // namespace fcl_prob::cli
