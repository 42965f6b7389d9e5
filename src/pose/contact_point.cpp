// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/contact_point.h"

#include <fcl/narrowphase/collision.h>

#include <memory>

#include "fcl_prob/triangle_mesh.h"
#include "fcl_prob/whitening.h"
#include "geometry/geometry_kind.h"
#include "geometry/mesh_visitor.h"
#include "montecarlo/random_samples.h"

namespace fcl_prob::detail {
namespace {

constexpr std::uint64_t kStream = 0x636f6e74;
constexpr std::uint64_t kSamples = 200;
constexpr int kEnoughHits = 40;

// The middle of the parts of the two bounding boxes that are nearest to each other.
Eigen::Vector3d betweenBoxes(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                             const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b) {
  const auto box = [](const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose) {
    fcl::AABBd result;
    for (int corner = 0; corner < 8; ++corner) {
      Eigen::Vector3d point;
      for (int k = 0; k < 3; ++k) {
        const bool low = (corner >> k) % 2 == 0;
        point[k] = low ? geometry.aabb_local.min_[k] : geometry.aabb_local.max_[k];
      }
      result += Eigen::Vector3d(pose * point);
    }
    return result;
  };
  const fcl::AABBd of_a = box(a, pose_a);
  const fcl::AABBd of_b = box(b, pose_b);
  const Eigen::Vector3d lo = of_a.min_.cwiseMax(of_b.min_);
  const Eigen::Vector3d hi = of_a.max_.cwiseMin(of_b.max_);
  return 0.5 * (lo + hi);
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

}  // namespace

Eigen::Vector3d likelyContact(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
                              const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement, std::uint64_t seed) {
  Eigen::Vector3d point = betweenBoxes(a, pose_a, b, pose_b);
  // Contacts of triangles only: those of shapes come from an iteration that need not end.
  if (kindOf(a) != GeometryKind::mesh || kindOf(b) != GeometryKind::mesh) return point;
  const auto model_a = buildModel<fcl::OBBRSSd>(triangleMesh(meshView(a)));
  const auto model_b = buildModel<fcl::OBBRSSd>(triangleMesh(meshView(b)));
  meanContact(*model_a, pose_a, *model_b, pose_b, displacement, seed, point);
  return point;
}

}  // namespace fcl_prob::detail
