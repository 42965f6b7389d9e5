// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// GeneralPCD over trees of the library's own bounding volumes, by name.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fcl_prob/general_pcd.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::cli {

/// Two meshes with trees of the same bounding volume, at poses of A and B.
using TreePair = std::function<GeneralPcdResult(
    const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
    const GaussianDisplacement& displacement, const GeneralPcdRequest& request)>;

/// "sphere", "kdop26" and "convex": the bounding volumes that FCL does not have. Only general-pcd
/// can use them.
const std::vector<std::string>& ownVolumeNames();
bool isOwnVolume(const std::string& bounding_volume);

/// \param bounding_volume  one of ownVolumeNames()
/// \throws InvalidGeometry
TreePair makeTreePair(const std::string& bounding_volume, const TriangleMesh& a,
                      const TriangleMesh& b);

}  // namespace fcl_prob::cli
