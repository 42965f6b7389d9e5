// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl::collide for two groups at given poses.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "geometry/displaced_collider.h"

namespace fcl_prob::detail {

using GeometryList = std::vector<std::shared_ptr<const fcl::CollisionGeometryd>>;

/// Where the members are in one sample, metres, world frame.
struct SampledPlacement {
  std::vector<fcl::Transform3d> poses_a;
  std::vector<fcl::Transform3d> poses_b;
};

/// Const calls are safe on several threads. The geometries must outlive it.
class PlacementCollider {
 public:
  /// \throws as DisplacedCollider, of every pair of members
  PlacementCollider(const GeometryList& a, const GeometryList& b, ContactMeaning contact);

  /// Whether any member of A collides with any of B.
  bool collides(const SampledPlacement& placement) const;

  /// See DisplacedCollider::plan().
  const std::vector<std::string>& plan() const { return colliders_.front().plan(); }

 private:
  std::size_t members_of_b_;
  std::vector<DisplacedCollider> colliders_;
};

}  // namespace fcl_prob::detail
