// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/contact_point.h"

#include <fcl/geometry/shape/capsule.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <memory>

#include "base/random_words.h"
#include "fcl_prob/triangle_mesh.h"
#include "fcl_prob/whitening.h"
#include "geometry/geometry_kind.h"
#include "geometry/mesh_visitor.h"
#include "scene/whitened_tree.h"

namespace fcl_prob::detail {
namespace {

constexpr std::uint64_t kStream = 0x636f6e74;
constexpr std::uint64_t kSamples = 200;
constexpr int kEnoughHits = 40;

// The middle of what the two bounding boxes share, or of the gap between them.
Eigen::Vector3d betweenBoxes(const PartitionObject& a, const PartitionObject& b) {
  const Whitening metres(GaussianDisplacement::fromStandardDeviations({1.0, 1.0, 1.0}));
  const WhitenedPair pair = whiten(a, b, metres);
  Eigen::Vector3d middle;
  for (int k = 0; k < 3; ++k) {
    middle[k] = 0.5 * std::max(pair.a.boxOf(0).lo[k], pair.b.boxOf(0).lo[k]) +
                0.5 * std::min(pair.a.boxOf(0).hi[k], pair.b.boxOf(0).hi[k]);
  }
  // Whitened frames have their origin at the middle of the first part of A, and axes of their own.
  return a.parts[0].pose * a.tree->parts[0].origin + metres.inverse() * middle;
}

// The mean of the contacts at displaced poses, each moved back with A; nothing without contact.
bool meanContact(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                 const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                 const GaussianDisplacement& displacement, std::uint64_t seed,
                 Eigen::Vector3d& mean) {
  const Whitening whitening(displacement);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int hits = 0;
  for (std::uint64_t i = 0; i < kSamples && hits < kEnoughHits; ++i) {
    Eigen::Vector3d y = standardNormalFrom(randomWords({seed, kStream}, i));
    for (int k = whitening.rank(); k < 3; ++k) y[k] = 0.0;
    const Eigen::Vector3d moved = whitening.unapply(y);
    fcl::Transform3d displaced = pose_a;
    displaced.translation() += moved;
    fcl::CollisionResultd result;
    fcl::collide(&a, displaced, &b, pose_b, fcl::CollisionRequestd(16, true), result);
    if (!result.isCollision()) continue;
    Eigen::Vector3d contacts = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < result.numContacts(); ++k) contacts += result.getContact(k).pos;
    sum += contacts / static_cast<double>(result.numContacts()) - moved;
    ++hits;
  }
  if (hits == 0 || !sum.allFinite()) return false;
  mean = sum / hits;
  return true;
}

// A sphere or a capsule turns as its centre or its axis does: the nearest point of that.
Eigen::Vector3d nearestOfCore(const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose,
                              const Eigen::Vector3d& point) {
  double half = 0.0;
  if (geometry.getNodeType() == fcl::GEOM_CAPSULE) {
    half = 0.5 * static_cast<const fcl::Capsuled&>(geometry).lz;
  } else if (geometry.getNodeType() != fcl::GEOM_SPHERE) {
    return point;
  }
  const Eigen::Vector3d axis = pose.linear().col(2);
  const double along = std::clamp(axis.dot(point - pose.translation()), -half, half);
  return pose.translation() + along * axis;
}

}  // namespace

Eigen::Vector3d likelyContact(const PreparedGeometry& prepared_a, const fcl::Transform3d& pose_a,
                              const PreparedGeometry& prepared_b, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement, std::uint64_t seed) {
  Eigen::Vector3d point = betweenBoxes({&prepared_a.pieces(), {{pose_a, nullptr}}},
                                       {&prepared_b.pieces(), {{pose_b, nullptr}}});
  const fcl::CollisionGeometryd& a = prepared_a.geometry();
  const fcl::CollisionGeometryd& b = prepared_b.geometry();
  // Contacts of triangles only: those of shapes come from an iteration that need not end.
  if (kindOf(a) != GeometryKind::mesh || kindOf(b) != GeometryKind::mesh) {
    return nearestOfCore(a, pose_a, point);
  }
  const auto model_a = buildModel<fcl::OBBRSSd>(triangleMesh(meshView(a)));
  const auto model_b = buildModel<fcl::OBBRSSd>(triangleMesh(meshView(b)));
  meanContact(*model_a, pose_a, *model_b, pose_b, displacement, seed, point);
  return point;
}

}  // namespace fcl_prob::detail
