// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sampling/placement_collider.h"

namespace fcl_prob::detail {

PlacementCollider::PlacementCollider(const GeometryList& a, const GeometryList& b,
                                     ContactMeaning contact)
    : members_of_b_(b.size()) {
  const fcl::Transform3d anywhere = fcl::Transform3d::Identity();
  for (const auto& of_a : a) {
    for (const auto& of_b : b) {
      colliders_.emplace_back(*of_a, anywhere, *of_b, anywhere, contact);
    }
  }
}

bool PlacementCollider::collides(const SampledPlacement& placement) const {
  for (std::size_t i = 0; i < colliders_.size(); ++i) {
    if (colliders_[i].collidesAt(placement.poses_a[i / members_of_b_],
                                 placement.poses_b[i % members_of_b_])) {
      return true;
    }
  }
  return false;
}

}  // namespace fcl_prob::detail
