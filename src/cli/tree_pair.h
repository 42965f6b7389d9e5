// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// GeneralPCD over trees of the library's own bounding volumes, by name, and as a query.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fcl_prob/general_pcd.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
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

/// What the request asks of GeneralPCD. \throws InvalidRequest that says `refusal` unless its
/// method is general-pcd or general-pcd-min
GeneralPcdRequest pcdRequestOf(const ProbabilityRequest& request, const std::string& refusal);
ProbabilityResult resultOf(const GeneralPcdResult& pcd, const ProbabilityRequest& request);

}  // namespace fcl_prob::cli
