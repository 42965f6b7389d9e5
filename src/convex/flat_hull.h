// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Extreme points of point sets without volume.
#pragma once

#include <vector>

#include "convex/spanning_frame.h"

namespace fcl_prob::detail {

/// Indices of the extreme points of a point, a segment or a flat polygon (counter-clockwise about
/// the frame's third direction). The frame's dimension is below 3, or its third is to be ignored.
std::vector<int> flatHull(const std::vector<Eigen::Vector3d>& points, const SpanningFrame& frame);

}  // namespace fcl_prob::detail
