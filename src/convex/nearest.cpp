// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/nearest.h"

#include <fcl/narrowphase/detail/convexity_based_algorithm/gjk_libccd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace fcl_prob::detail {
namespace {

constexpr unsigned kGjkIterations = 60;
constexpr double kGjkTolerance = 1e-7;  // whitened units, absolute

/// A plane that is so far away, as a share of the nearest point, is good enough, or was not found
/// in so many steps: 1e-3 of 3 deviations is 1 % of the mass behind it.
constexpr double kCloseEnough = 0.999;
constexpr int kMostSteps = 30;

/// The point of a segment nearest to the origin.
Eigen::Vector3d nearestOnSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  if (!(squared > 0.0)) return a;
  return a + std::clamp(-a.dot(along) / squared, 0.0, 1.0) * along;
}

/// The point of a face nearest to the origin; `foot` is the origin's projection on its plane.
Eigen::Vector3d nearestOnFace(const FaceSet& faces, std::size_t face, const Eigen::Vector3d& normal,
                              const Eigen::Vector3d& foot) {
  const int count = faces.cornerCount(face);
  bool inside = true;
  for (int i = 0; i < count && inside; ++i) {
    const Eigen::Vector3d& from = faces.position(face, i);
    const Eigen::Vector3d edge = faces.position(face, (i + 1) % count) - from;
    inside = edge.cross(foot - from).dot(normal) >= 0.0;
  }
  if (inside) return foot;
  Eigen::Vector3d best = faces.position(face, 0);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d candidate =
        nearestOnSegment(faces.position(face, i), faces.position(face, (i + 1) % count));
    if (candidate.squaredNorm() < best.squaredNorm()) best = candidate;
  }
  return best;
}

bool isAcross(const Eigen::Vector3d& normal, int rank) {
  for (int k = rank; k < 3; ++k) {
    if (std::abs(normal[k]) > 0.5) return true;
  }
  return false;
}

void supportOfObstacle(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const Eigen::Vector3d found = static_cast<const CObstacle*>(object)->supportPoint(
      {direction->v[0], direction->v[1], direction->v[2]});
  ccdVec3Set(point, found.x(), found.y(), found.z());
}

void supportOfOrigin(const void*, const ccd_vec3_t*, ccd_vec3_t* point) {
  ccdVec3Set(point, 0.0, 0.0, 0.0);
}

/// What GJK ends with where a face looks exactly at the origin may be far off. Towards the nearest
/// point so far, which comes nearer along the segment to a support point (Gilbert 1966), as long as
/// the plane there is much nearer than that point.
Eigen::Vector3d improved(const CObstacle& obstacle, Eigen::Vector3d x) {
  Eigen::Vector3d towards = x.stableNormalized();
  Eigen::Vector3d point = obstacle.supportPoint(-towards);
  double farthest = point.dot(towards);
  for (int i = 0; i < kMostSteps && farthest < kCloseEnough * x.norm(); ++i) {
    x = nearestOnSegment(x, point);
    if (!(x.squaredNorm() > 0.0)) break;
    const Eigen::Vector3d n = x.normalized();
    point = obstacle.supportPoint(-n);
    if (!(point.dot(n) > farthest)) continue;
    farthest = point.dot(n);
    towards = n;
  }
  return towards;
}

}  // namespace

Separation separationOf(const FaceSet& faces, int rank) {
  Separation separation;
  double farthest = -std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    const Eigen::Vector3d area = faces.vectorArea(f);
    const double norm = area.norm();
    if (!(norm > 0.0)) continue;
    const Eigen::Vector3d normal = area / norm;
    if (isAcross(normal, rank)) continue;
    const double offset = normal.dot(faces.position(f, 0));
    if (-offset > farthest) {
      farthest = -offset;
      separation.face = -normal;
    }
    if (offset >= 0.0) continue;  // only faces that the origin sees can hold the nearest point
    const Eigen::Vector3d point = nearestOnFace(faces, f, normal, offset * normal);
    if (point.squaredNorm() < nearest) {
      nearest = point.squaredNorm();
      separation.nearest = point.normalized();
    }
  }
  if (farthest <= 0.0) {
    separation.nearest.setZero();
    separation.depth = -farthest;
  }
  return separation;
}

Eigen::Vector3d gjkDirection(const CObstacle& obstacle) {
  try {
    double distance = -1.0;
    Eigen::Vector3d on_obstacle;
    Eigen::Vector3d at_origin;
    // GJK only reads the objects, although FCL's interface takes pointers to mutable ones.
    void* object = const_cast<CObstacle*>(&obstacle);
    const bool apart = fcl::detail::GJKDistance<double>(
        object, supportOfObstacle, object, supportOfOrigin, kGjkIterations, kGjkTolerance,
        &distance, &on_obstacle, &at_origin);
    if (apart && distance > 0.0 && on_obstacle.allFinite()) {
      return improved(obstacle, on_obstacle);
    }
  } catch (const std::exception&) {
    // FCL reports degenerate simplices this way; a proposal less.
  }
  return Eigen::Vector3d::Zero();
}

Eigen::Vector3d longestEdgeAcross(const FaceSet& faces, const Eigen::Vector3d& axis) {
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  const auto consider = [&](const Eigen::Vector3d& edge) {
    const Eigen::Vector3d across = edge - axis.dot(edge) * axis;
    if (across.squaredNorm() > longest.squaredNorm()) longest = across;
  };
  for (const Eigen::Vector3d& edge : faces.edgeVectors()) consider(edge);
  if (faces.edgeVectors().empty()) {
    for (std::size_t f = 0; f < faces.faceCount(); ++f) {
      const int count = faces.cornerCount(f);
      for (int i = 0; i < count; ++i) {
        consider(faces.position(f, (i + 1) % count) - faces.position(f, i));
      }
    }
  }
  if (!(longest.norm() > 0.0) || !longest.allFinite()) return axis.unitOrthogonal();
  longest.normalize();
  return (longest - axis.dot(longest) * axis).normalized();
}

}  // namespace fcl_prob::detail
