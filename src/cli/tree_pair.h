// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// GeneralPCD over trees of any bounding volume, FCL's or the library's own, by name.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fcl_prob/general_pcd.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::cli {

/// Two meshes with trees of the same bounding volume.
class TreePair {
 public:
  virtual ~TreePair() = default;

  virtual GeneralPcdResult bound(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                                 const GaussianDisplacement& displacement,
                                 const GeneralPcdRequest& request) const = 0;

  /// Volumes of the tree of the first mesh, see volumesByLevel().
  virtual std::vector<double> volumes(int levels) const = 0;
};

/// "sphere", "kdop26" and "convex": the bounding volumes that FCL does not have. Only general-pcd
/// can use them.
const std::vector<std::string>& ownVolumeNames();
bool isOwnVolume(const std::string& bounding_volume);

/// \param bounding_volume  one of boundingVolumeNames(), of FCL or our own
/// \throws InvalidGeometry, InvalidRequest if there is no such bounding volume
std::unique_ptr<TreePair> makeTreePair(const std::string& bounding_volume, const TriangleMesh& a,
                                       const TriangleMesh& b);

}  // namespace fcl_prob::cli
