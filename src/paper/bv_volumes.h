// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Volumes of bounding volumes, to compare them by.
#pragma once

#include <vector>

#include "convex/bounding_volumes.h"
#include "convex/convex_mesh.h"

namespace fcl_prob::detail {

/// Of a polytope with its faces, cubic metres.
double volumeOf(const ConvexMesh& mesh);

/// Volume of the convex set that a bounding volume is, cubic metres. FCL's own volume() is that of
/// the enclosing box for k-DOPs, and not the volume for RSS. Of OBBRSS that of the OBB counts, of
/// kIOS the least of its OBB and its spheres: what generalPcd() uses.
double volumeOf(const fcl::AABBd& box);
double volumeOf(const fcl::OBBd& box);
double volumeOf(const fcl::RSSd& rss);
double volumeOf(const fcl::OBBRSSd& both);
double volumeOf(const fcl::kIOSd& kios);
double volumeOf(const SphereBv& sphere);
double volumeOfSlabs(const std::vector<Slab>& slabs);

inline double volumeOf(const Kdop26& dop) { return volumeOfSlabs(slabsOf(dop)); }
template <std::size_t N>
double volumeOf(const fcl::KDOP<double, N>& dop) {
  return volumeOfSlabs(slabsOf(dop));
}

}  // namespace fcl_prob::detail
