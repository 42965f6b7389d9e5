// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Bounding volumes as the convex sets that they are.
#pragma once

#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/OBB.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/bv/RSS.h>
#include <fcl/math/bv/kDOP.h>
#include <fcl/math/bv/kIOS.h>

#include <vector>

#include "convex/c_obstacle.h"
#include "fcl_prob/kdop26.h"
#include "fcl_prob/sphere_bv.h"

namespace fcl_prob::detail {

RoundedZonotope roundedZonotope(const fcl::AABBd& box);
RoundedZonotope roundedZonotope(const fcl::OBBd& box);
RoundedZonotope roundedZonotope(const fcl::RSSd& rss);
RoundedZonotope roundedZonotope(const SphereBv& sphere);

/// Its OBB, which contains what the OBBRSS bounds.
RoundedZonotope roundedZonotope(const fcl::OBBRSSd& both);

/// Its OBB; the spheres of a kIOS are further sets that each contain what it bounds.
RoundedZonotope roundedZonotope(const fcl::kIOSd& kios);

/// The smallest of the spheres of a kIOS.
RoundedZonotope smallestSphere(const fcl::kIOSd& kios);

/// The slabs of a k-DOP in its own frame.
void setToSlabsOf(const Kdop26& dop, std::vector<Slab>& slabs);
template <std::size_t N>
void setToSlabsOf(const fcl::KDOP<double, N>& dop, std::vector<Slab>& slabs) {
  slabs.clear();
  for (std::size_t k = 0; k < N / 2; ++k) {
    slabs.push_back({dopDirections()[k], dop.dist(k), dop.dist(k + N / 2)});
  }
}
template <typename Dop>
std::vector<Slab> slabsOf(const Dop& dop) {
  std::vector<Slab> slabs;
  setToSlabsOf(dop, slabs);
  return slabs;
}

/// The slabs of B ⊕ (−A), both in one frame: to `slabs_of_b` those of A are added, reversed.
void addReversed(const std::vector<Slab>& slabs_of_a, std::vector<Slab>& slabs_of_b);

/// The polytope between slabs (see setToSlabs()), widened by 1e-14 of its size.
ConvexMesh meshOfSlabs(const std::vector<Slab>& slabs);

}  // namespace fcl_prob::detail
