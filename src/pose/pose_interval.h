// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The certified interval over poses: rotations in cells, translations in a partition for each.
#pragma once

#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "pose/moved_frame.h"
#include "query/prepared_geometry.h"

namespace fcl_prob::detail {

/// \param error  of A's pose; its rotation must vary
/// \throws UnsupportedGeometry for unbounded shapes, OpenMesh
ProbabilityResult poseInterval(const PreparedGeometry& a, const fcl::Transform3d& pose_a,
                               const PreparedGeometry& b, const fcl::Transform3d& pose_b,
                               const PoseError& error, const ProbabilityRequest& request);

}  // namespace fcl_prob::detail
