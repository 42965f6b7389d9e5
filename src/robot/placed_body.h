// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#pragma once

#include <fcl/common/types.h>

#include <cstddef>

namespace fcl_prob::detail {

/// A body of the robot at one of the waypoints.
struct PlacedBody {
  std::size_t body;
  fcl::Transform3d pose;  ///< metres, world frame
};

}  // namespace fcl_prob::detail
