// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Trees of any bounding volume, FCL's or the library's own: their volumes, and GeneralPCD over
// them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fcl_prob/general_pcd.h"
#include "fcl_prob/triangle_mesh.h"
#include "geometry/enclosed_volume.h"
#include "paper/bv_volumes.h"

namespace fcl_prob::cli {

using detail::enclosedVolume;
using detail::volumeOf;

/// Volume of the convex hull of its vertices, cubic metres.
double hullVolume(const TriangleMesh& mesh);

/// Two meshes with trees of the same bounding volume.
class VolumeTrees {
 public:
  virtual ~VolumeTrees() = default;

  virtual GeneralPcdResult bound(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                                 const GaussianDisplacement& displacement,
                                 const GeneralPcdRequest& request) const = 0;

  /// For levels 0 to `levels` - 1 of the tree of the first mesh: the volumes of all nodes at that
  /// depth, added up. Where nodes overlap, their common volume counts more than once. A leaf counts
  /// at all levels below it.
  virtual std::vector<double> volumes(int levels) const = 0;
};

/// \param bounding_volume  one of boundingVolumeNames(), of FCL or our own
/// \throws InvalidGeometry, InvalidRequest if there is no such bounding volume
std::unique_ptr<VolumeTrees> makeVolumeTrees(const std::string& bounding_volume,
                                             const TriangleMesh& a, const TriangleMesh& b);

}  // namespace fcl_prob::cli
